#include "calibration/parameter_bounds.h"

#include <ceres/ceres.h>
#include <ceres/version.h>

namespace live_stiffness {

void addBoundedBlock(ceres::Problem& problem, Eigen::VectorXd& x, const std::vector<SceneParameter>& parameters) {
  problem.AddParameterBlock(x.data(), static_cast<int>(x.size()));
  for (size_t k = 0; k < parameters.size(); ++k) {
    const SceneParameter& p = parameters[k];
    problem.SetParameterLowerBound(x.data(), static_cast<int>(k), (p.low - p.start) / p.prior_sigma);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(k), (p.high - p.start) / p.prior_sigma);
  }
}

void hold(ceres::Problem& problem, Eigen::VectorXd& x, const std::vector<int>& entries) {
  const int count = static_cast<int>(x.size());
  if (static_cast<int>(entries.size()) == count) {
    problem.SetParameterBlockConstant(x.data());
    return;
  }
  problem.SetParameterBlockVariable(x.data());
#if CERES_VERSION_MAJOR > 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR >= 1)
  problem.SetManifold(x.data(), entries.empty() ? nullptr : new ceres::SubsetManifold(count, entries));
#else
  problem.SetParameterization(x.data(), new ceres::SubsetParameterization(count, entries));
#endif
}

std::vector<int> pressedAgainstBounds(ceres::Problem& problem, Eigen::VectorXd& x,
                                      const std::vector<SceneParameter>& parameters) {
  hold(problem, x, {});
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {x.data()};
  options.num_threads = 1;
  double cost = 0.0;
  std::vector<double> gradient;
  std::vector<int> pressed;
  if (!problem.Evaluate(options, &cost, nullptr, &gradient, nullptr)) return pressed;
  for (int k = 0; k < static_cast<int>(x.size()); ++k) {
    const SceneParameter& p = parameters[static_cast<size_t>(k)];
    const double value = p.start + p.prior_sigma * x[k], near = 1e-9 * (p.high - p.low);
    if ((value < p.low + near && gradient[static_cast<size_t>(k)] > 0.0) ||
        (value > p.high - near && gradient[static_cast<size_t>(k)] < 0.0))
      pressed.push_back(k);
  }
  return pressed;
}

}  // namespace live_stiffness
