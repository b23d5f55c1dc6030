#include "benchmark/methods/library_method.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {

LibraryMethod::LibraryMethod(std::string name, const Scene& scene, const ModelOptions& options, int stations)
    : StiffnessMethod(std::move(name)), model_(scene, options), workspace_(model_.makeWorkspace()),
      stations_(stations) {
  for (int k = 1; k <= stations; ++k) {
    const double along = static_cast<double>(k) / stations * scene.segmentCount();
    const int segment = std::clamp(static_cast<int>(std::ceil(along - 1e-9)) - 1, 0, scene.segmentCount() - 1);
    places_.emplace_back(segment, std::min(1.0, along - segment));
  }
}

MethodSolution LibraryMethod::solve(PressuresRef pressures) {
  const StiffnessSolution solution = model_.solve(pressures, Wrench::Zero(), workspace_);
  if (solution.status.ok())
    for (size_t k = 0; k < places_.size(); ++k)
      stations_[k] = model_.station(workspace_, places_[k].first, places_[k].second);
  return {solution.status.ok(), solution.X_BT, solution.compliance, solution.material_compliance};
}

}  // namespace live_stiffness
