// Scene files: refused with a ConfigurationError, or a scene that can be solved without ever giving NaN.

#include "analysis/scene_description.h"
#include "fuzz_target.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/rod/scene_file.h"

using namespace live_stiffness;

namespace {

void solve(const StiffnessModel& model, double pressure, StiffnessWorkspace& workspace) {
  const Pressures pressures = Pressures::Constant(model.scene().chamberCount(), pressure);
  const StiffnessSolution solution = model.solve(pressures, Wrench::Zero(), workspace);
  if (!solution.status.ok()) {
    require(!model.describe(solution.status).empty(), "a failure is described");
    return;
  }
  require(solution.X_BT.p.allFinite() && solution.X_BT.R.allFinite(), "a pose is finite");
  require(solution.compliance.allFinite(), "a compliance is finite");
  require(solution.material_compliance.allFinite(), "a material compliance is finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  constexpr int kMostSegments = 4;  // solved; more only cost time
  Scene scene;
  try {
    scene = parseScene(textOf(data, size), "fuzz");
  } catch (const ConfigurationError& error) {
    require(!error.faults().empty(), "a refusal has a reason");
    return 0;
  }
  require(scene.segmentCount() > 0, "a scene has a segment");
  doubtsAbout(scene);  // never throws
  if (scene.segmentCount() > kMostSegments) return 0;
  ModelOptions options;
  options.accuracy = 1e-4;
  const StiffnessModel model(scene, options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  solve(model, 0.0, workspace);
  solve(model, 2e4, workspace);
  return 0;
}
