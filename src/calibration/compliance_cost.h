#pragma once
// Residuals of a row of a compliance table.

#include <functional>
#include <memory>

#include "live_stiffness/conventions.h"

namespace ceres {
class CostFunction;
}

namespace live_stiffness {

// Compliance of the row at x, m/N. False if there is no solution.
using RowCompliance = std::function<bool(const double* x, Matrix3& compliance)>;

// Errors of the row's nine entries and of its norm, which (42) compares, divided by `sigma` times the measured norm. Block: x.
std::unique_ptr<ceres::CostFunction> complianceCost(RowCompliance compliance, const Matrix3& measured, double sigma,
                                                    int parameters);

}  // namespace live_stiffness
