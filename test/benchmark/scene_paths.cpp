#include "benchmark/scene_paths.h"

#include <cmath>
#include <stdexcept>

namespace live_stiffness {

Scene hangingChain(int segments) {
  Scene scene = paperScene(1);
  const Body segment = scene.chain[0];
  for (int k = 1; k < segments; ++k) {
    scene.chain.push_back(Link{0.006, 0.0});
    scene.chain.push_back(segment);
  }
  scene.gravity = Vector3(0.0, 0.0, kStandardGravity);
  return scene;
}

std::vector<Pressures> pressurePath(int segments, bool alternating) {
  constexpr int kUpdates = 128;
  std::vector<Pressures> path;
  for (int i = 0; i < kUpdates; ++i) {
    const double bar = 0.4 * std::pow(1.01, std::min(i, kUpdates - i));
    Pressures pressures(6 * segments);
    for (int k = 0; k < segments; ++k) {
      const bool other_way = alternating && k % 2 == 1;
      pressures.segment<6>(6 * k) =
          other_way ? bars(bar, {0.0, 0.0, 0.6, 0.6, 1.0, 1.0}) : bars(bar, {1.0, 1.0, 0.6, 0.6, 0.0, 0.0});
    }
    path.push_back(pressures);
  }
  return path;
}

std::vector<StiffnessSolution> exactSolutions(const Scene& scene, const std::vector<Pressures>& path) {
  const StiffnessModel model(scene, accurateTo(1e-12));
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
