#include "calibration/compliance_cost.h"

#include <ceres/cost_function.h>

#include <vector>

namespace live_stiffness {
namespace {

// Derivatives by central differences of solves to 1e-12. A table has few rows, so this costs less than a millisecond.
class ComplianceCost : public ceres::CostFunction {
 public:
  ComplianceCost(RowCompliance compliance, const Matrix3& measured, double sigma, int parameters)
      : compliance_(std::move(compliance)), measured_(measured), scale_(1.0 / (sigma * measured.norm())) {
    set_num_residuals(10);
    mutable_parameter_block_sizes()->push_back(parameters);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const int count = parameter_block_sizes()[0];
    if (!evaluate(blocks[0], residuals)) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    constexpr double kStep = 1e-4;  // of a prior sigma: truncation 1e-8 of the change, rounding 1e-8 too
    std::vector<double> x(blocks[0], blocks[0] + count);
    double above[10], below[10];
    for (int k = 0; k < count; ++k) {
      const double at = x[k];
      x[k] = at + kStep;
      if (!evaluate(x.data(), above)) return false;
      x[k] = at - kStep;
      if (!evaluate(x.data(), below)) return false;
      x[k] = at;
      for (int i = 0; i < 10; ++i) jacobians[0][i * count + k] = (above[i] - below[i]) / (2.0 * kStep);
    }
    return true;
  }

 private:
  bool evaluate(const double* x, double* residuals) const {
    Matrix3 C;
    if (!compliance_(x, C)) return false;
    Eigen::Map<Matrix3> entries(residuals);
    entries = scale_ * (C - measured_);
    residuals[9] = scale_ * (C.norm() - measured_.norm());
    return true;
  }

  RowCompliance compliance_;
  Matrix3 measured_;
  double scale_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> complianceCost(RowCompliance compliance, const Matrix3& measured, double sigma,
                                                    int parameters) {
  return std::make_unique<ComplianceCost>(std::move(compliance), measured, sigma, parameters);
}

}  // namespace live_stiffness
