#include "benchmark/methods/library_method.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {

LibraryMethod::LibraryMethod(std::string name, const Scene& scene, const ModelOptions& options, int stations,
                             int stages, Simd simd)
    : StiffnessMethod(std::move(name)), model_(scene, options),
      workspace_(std::make_unique<StiffnessWorkspace::State>(model_.scene(), options.accuracy, stages, simd)),
      stations_(scene.segmentCount()) {
  const int segments = scene.segmentCount();
  std::vector<std::vector<double>> fractions(segments);
  for (int k = 1; k <= stations; ++k) {
    const double along = static_cast<double>(k) / stations * segments;
    const int segment = std::clamp(static_cast<int>(std::ceil(along - 1e-9)) - 1, 0, segments - 1);
    fractions[segment].push_back(std::min(1.0, along - segment));
  }
  for (int k = 0; k < segments; ++k) {
    plans_.emplace_back(fractions[k]);
    stations_[k].resize(fractions[k].size());
  }
}

StiffnessSolution LibraryMethod::solve(PressuresRef pressures) {
  StiffnessSolution solution = model_.solve(pressures, Wrench::Zero(), workspace_);
  for (size_t k = 0; solution.status.ok() && k < plans_.size(); ++k)
    if (plans_[k].size() > 0) model_.stations(workspace_, static_cast<int>(k), plans_[k], stations_[k].data());
  return solution;
}

}  // namespace live_stiffness
