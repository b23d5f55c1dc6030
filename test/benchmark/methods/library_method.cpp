#include "benchmark/methods/library_method.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {

LibraryMethod::LibraryMethod(std::string name, const Scene& scene, const ModelOptions& options, int stations)
    : StiffnessMethod(std::move(name)), model_(scene, options), workspace_(model_.makeWorkspace()),
      fractions_(scene.segmentCount()), stations_(scene.segmentCount()) {
  const int segments = scene.segmentCount();
  for (int k = 1; k <= stations; ++k) {
    const double along = static_cast<double>(k) / stations * segments;
    const int segment = std::clamp(static_cast<int>(std::ceil(along - 1e-9)) - 1, 0, segments - 1);
    fractions_[segment].push_back(std::min(1.0, along - segment));
  }
}

StiffnessSolution LibraryMethod::solve(PressuresRef pressures) {
  StiffnessSolution solution = model_.solve(pressures, Wrench::Zero(), workspace_);
  for (size_t k = 0; solution.status.ok() && k < fractions_.size(); ++k)
    if (!fractions_[k].empty()) model_.stations(workspace_, static_cast<int>(k), fractions_[k], stations_[k]);
  return solution;
}

}  // namespace live_stiffness
