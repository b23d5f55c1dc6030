#pragma once
// Parallel robots that several tests share.

#include <cmath>
#include <string>

#include "live_stiffness/parallel/parallel_model.h"
#include "live_stiffness/parallel/parallel_scene_file.h"

namespace live_stiffness {

inline ParallelScene stewartGough() {
  return loadParallelSceneFile(std::string(SOURCE_DIR) + "/config/scenes/stewart_gough.yaml");
}

// The same with weight, obliquely, an eccentric platform, holes at different heights with leaning axes, and rods of two
// kinds: nothing left of its symmetry.
inline ParallelScene awkwardRobot() {
  ParallelScene scene = stewartGough();
  scene.gravity = Vector3(1.5, -2.0, -9.0);
  scene.platform_mass = 0.15;
  scene.platform_centre = Vector3(0.01, -0.02, 0.03);
  for (int i = 0; i < 6; ++i) {
    scene.rods[i].X_BD.p.z() += 0.004 * i;
    scene.rods[i].X_BD.R = expSo3(Vector3(0.03 * i, -0.05, 0.0));
    scene.rods[i].X_PE.R = expSo3(Vector3(-0.04, 0.02 * i, 0.1));
  }
  scene.rods[2].section.outer_radius = 0.0012;
  return scene;
}

// Fig. 18: the robot (a) elongates, (b) translates, (c) bends. The print gives the pose of (b) alone.
inline Pose figure18Pose(char configuration) {
  if (configuration == 'a') return {Matrix3::Identity(), Vector3(0.0, 0.0, 0.5)};
  if (configuration == 'b') return {Matrix3::Identity(), Vector3(0.1, 0.0, 0.4)};
  return {expSo3(Vector3(0.0, radians(30.0), 0.0)), Vector3(0.0, 0.0, 0.4)};
}

// Lengths that differ by up to a few per cent, so that the platform leans and shifts.
inline std::vector<double> unevenLengths() { return {0.40, 0.41, 0.405, 0.42, 0.415, 0.41}; }

inline ParallelSolution solveCold(const ParallelModel& model, const std::vector<double>& lengths,
                                  const Wrench& wrench = Wrench::Zero()) {
  ParallelWorkspace workspace = model.makeWorkspace();
  return model.solve(lengths, wrench, workspace);
}

}  // namespace live_stiffness
