#include <iostream>

#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/rod/scene_file.h"

using namespace live_stiffness;

int main(int argc, char** argv) {
  const StiffnessModel model(loadSceneFile(argc > 1 ? argv[1] : "scene.yaml"), ModelOptions{});
  StiffnessWorkspace workspace = model.makeWorkspace();
  Pressures pressures = Pressures::Zero(model.scene().chamberCount());  // gauge, Pa, base to tip
  pressures.head(2).setConstant(60e3);                                  // 0.6 bar in the first two chambers
  const StiffnessSolution solution = model.solve(pressures, Wrench::Zero(), workspace);
  if (!solution.status.ok()) return std::cerr << model.describe(solution.status) << '\n', 1;
  std::cout << "tip, m: " << solution.X_BT.p.transpose() << '\n'
            << "compliance, [m; rad] per [N, N m]:\n" << solution.compliance << '\n';
}
