// Scenes of parallel robots: refused with a ConfigurationError, or a model can be made of them and says why it cannot
// reach lengths.

#include "fuzz_target.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/parallel/parallel_model.h"
#include "live_stiffness/parallel/parallel_scene_file.h"

using namespace live_stiffness;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  constexpr int kMostRods = 8;  // solved; more only cost time
  ParallelScene scene;
  try {
    scene = parseParallelScene(textOf(data, size), "fuzz");
  } catch (const ConfigurationError& error) {
    require(!error.faults().empty(), "a refusal has a reason");
    return 0;
  }
  require(scene.rodCount() > 0, "a scene has a rod");
  if (scene.rodCount() > kMostRods) return 0;
  ParallelOptions options;
  options.accuracy = 1e-4;
  const ParallelModel model(scene, options);
  ParallelWorkspace workspace = model.makeWorkspace();
  const ParallelSolution solution =
      model.solve(std::vector<double>(scene.rodCount(), 0.4), Wrench::Zero(), workspace);
  if (!solution.status.ok()) {
    require(!model.describe(solution.status).empty(), "a failure is described");
    return 0;
  }
  require(solution.X_BP.p.allFinite() && solution.X_BP.R.allFinite(), "a pose is finite");
  require(solution.compliance.allFinite() && solution.material_compliance.allFinite(), "a compliance is finite");
  return 0;
}
