#include "calibration/prior_cost.h"

#include <ceres/cost_function.h>

#include <algorithm>

namespace live_stiffness {
namespace {

class PriorCost : public ceres::CostFunction {
 public:
  PriorCost(int size, std::vector<int> entries, std::vector<double> means, std::vector<double> sigmas)
      : entries_(std::move(entries)), means_(std::move(means)), sigmas_(std::move(sigmas)) {
    set_num_residuals(static_cast<int>(entries_.size()));
    mutable_parameter_block_sizes()->push_back(size);
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const int size = parameter_block_sizes()[0];
    for (size_t k = 0; k < entries_.size(); ++k) residuals[k] = (blocks[0][entries_[k]] - means_[k]) / sigmas_[k];
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    std::fill(jacobians[0], jacobians[0] + entries_.size() * size, 0.0);
    for (size_t k = 0; k < entries_.size(); ++k) jacobians[0][k * size + entries_[k]] = 1.0 / sigmas_[k];
    return true;
  }

 private:
  std::vector<int> entries_;
  std::vector<double> means_, sigmas_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> priorCost(int size, std::vector<int> entries, std::vector<double> means,
                                               std::vector<double> sigmas) {
  return std::make_unique<PriorCost>(size, std::move(entries), std::move(means), std::move(sigmas));
}

}  // namespace live_stiffness
