#include "benchmark/estimate_check.h"

#include <cmath>

#include "benchmark/scene_paths.h"
#include "support/random_scene.h"

namespace live_stiffness {

EstimateShares checkEstimates(unsigned seed, int cases, const std::function<void(const EstimateCase&)>& on_case) {
  RandomSource random(seed);
  EstimateShares shares;
  for (shares.cases = 0; shares.cases < cases; ++shares.cases) {
    const RandomScene drawn = randomScene(random);
    EstimateCase result;
    result.segments = drawn.scene.segmentCount();
    result.requested = std::pow(10.0, random.uniform(-9.0, -3.0));
    result.loaded = drawn.scene.hasWeight() || !drawn.tip_wrench.isZero(0.0);
    const StiffnessModel model(drawn.scene, accurateTo(result.requested)), exact(drawn.scene, accurateTo(1e-13));
    const StiffnessSolution a = solveCold(model, drawn.pressures, drawn.tip_wrench);
    const StiffnessSolution b = solveCold(exact, drawn.pressures, drawn.tip_wrench);
    result.code = a.status.code;
    result.reference = b.status.code;
    ++shares.of_code[static_cast<int>(a.status.code)];
    shares.status_differs += a.status.ok() != b.status.ok();
    if (result.solved()) {
      result.estimate = a.numerical_error;
      result.error = errorsOf(a, b, drawn.scene.length()).largest();
      ++shares.solved;
      shares.loaded += result.loaded;
      shares.within_ten_estimates += result.withinTenEstimates();
      shares.within_requested += result.withinRequested();
      shares.worst_ratio = std::max(shares.worst_ratio, (result.error - EstimateCase::kReference) / result.estimate);
    }
    on_case(result);
  }
  return shares;
}

}  // namespace live_stiffness
