#include "benchmark/scene_paths.h"

#include <cmath>
#include <stdexcept>

#include "support/random_source.h"

namespace live_stiffness {

std::vector<Pressures> pressurePath(int segments) {
  constexpr int kUpdates = 128;
  std::vector<Pressures> path;
  for (int i = 0; i < kUpdates; ++i) {
    const double bar = 0.4 * std::pow(1.01, std::min(i, kUpdates - i));
    Pressures pressures(6 * segments);
    for (int k = 0; k < segments; ++k) pressures.segment<6>(6 * k) = bars(bar, {1.0, 1.0, 0.6, 0.6, 0.0, 0.0});
    path.push_back(pressures);
  }
  return path;
}

std::vector<Pressures> pressureWalk() {
  constexpr int kUpdates = 10000;
  RandomSource random(1);
  std::vector<Pressures> path;
  double pairs[] = {0.4, 0.5, 0.3};
  while (static_cast<int>(path.size()) <= kUpdates / 2) {
    for (double& bar : pairs) {
      const double next = bar * (random.uniform(0.0, 1.0) < 0.5 ? 0.99 : 1.01);
      if (next > 0.1 && next < 0.75) bar = next;
    }
    path.push_back(bars(1.0, {pairs[0], pairs[0], pairs[1], pairs[1], pairs[2], pairs[2]}));
  }
  for (int i = kUpdates / 2 - 1; i > 0; --i) path.push_back(path[i]);
  return path;
}

std::vector<StiffnessSolution> exactSolutions(const Scene& scene, const std::vector<Pressures>& path, double accuracy) {
  const StiffnessModel model(scene, accurateTo(accuracy));
  // Too small to matter; only there so that something external acts.
  const Wrench wrench = scene.hasWeight() ? Wrench(Wrench::Zero()) : Wrench(Wrench::Constant(1e-16));
  std::vector<StiffnessSolution> solutions;
  for (const Pressures& pressures : path) {
    solutions.push_back(solveCold(model, pressures, wrench));
    if (!solutions.back().status.ok())
      throw std::runtime_error("reference: " + model.describe(solutions.back().status));
  }
  return solutions;
}

}  // namespace live_stiffness
