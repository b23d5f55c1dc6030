#pragma once
// Priors of a calibration's unknowns.

#include <memory>
#include <vector>

namespace ceres {
class CostFunction;
}

namespace live_stiffness {

// (x - mean) / sigma of some entries of a block of `size`, linear.
std::unique_ptr<ceres::CostFunction> priorCost(int size, std::vector<int> entries, std::vector<double> means,
                                               std::vector<double> sigmas);

}  // namespace live_stiffness
