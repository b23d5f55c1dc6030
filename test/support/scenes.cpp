#include "support/scenes.h"

#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {

Scene paperScene(int segments) {
  const std::string name = segments == 1 ? "paper_one_segment" : "paper_two_segments";
  return loadSceneFile(std::string(SOURCE_DIR) + "/config/scenes/" + name + ".yaml");
}

Scene weightlessPaperScene(int segments) {
  Scene scene = paperScene(segments);
  scene.gravity.reset();
  return scene;
}

Scene awkwardScene() {
  Scene scene = paperScene(2);
  std::get<Link>(scene.chain[1]).mass = 0.007;
  scene.chain.emplace_back(Link{0.009, 0.004});
  scene.tip_mass = 0.006;
  scene.tip_offset = Vector3(0.004, -0.007, 0.011);
  scene.gravity = Vector3(2.5, -3.5, -8.0);
  return scene;
}

Segment& segmentOf(Scene& scene, int index) {
  for (Body& body : scene.chain)
    if (auto* segment = std::get_if<Segment>(&body); segment && index-- == 0) return *segment;
  throw std::out_of_range("no such segment");
}

Scene arm() { return loadSceneFile(SOURCE_DIR "/config/scenes/stiff_flop_recorded.yaml"); }

ModelOptions accurateTo(double accuracy) {
  ModelOptions options;
  options.accuracy = accuracy;
  return options;
}

Pressures bars(double bar, const std::vector<double>& pattern) {
  return 1e5 * bar * Eigen::Map<const Eigen::VectorXd>(pattern.data(), static_cast<Eigen::Index>(pattern.size()));
}

StiffnessSolution solveCold(const StiffnessModel& model, const Pressures& pressures, const Wrench& tip_wrench) {
  StiffnessWorkspace workspace = model.makeWorkspace();
  return model.solve(pressures, tip_wrench, workspace);
}

}  // namespace live_stiffness
