#include "calibration/carrying_moduli.h"

#include <algorithm>
#include <cmath>

#include "calibration/scene_parameter.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

long withoutEquilibrium(const Scene& scene, const ModelOptions& options, const std::vector<Pressures>& pressures, long most) {
  const StiffnessModel model(scene, options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  long count = 0;
  for (const Pressures& chambers : pressures) {
    if (model.solve(chambers, Wrench::Zero(), workspace).status.ok()) continue;
    if (++count > most) break;
    workspace = model.makeWorkspace();
  }
  return count;
}

std::optional<double> carryingFactor(const Scene& scene, const ModelOptions& options, const std::vector<Pressures>& pressures) {
  constexpr size_t kEnough = 400;  // evenly chosen
  constexpr int kLargest = 14, kSmallest = -7;  // powers of 2
  constexpr double kMargin = 1.25, kFine = 0.1;  // kFine: of a power of 2
  std::vector<Pressures> some;
  const size_t stride = 1 + pressures.size() / kEnough;
  for (size_t i = 0; i < pressures.size(); i += stride) some.push_back(pressures[i]);
  const auto few = static_cast<long>(kFewShare * static_cast<double>(some.size()));
  const auto carries = [&](double power) {
    return withoutEquilibrium(withModuliTimes(scene, std::exp2(power)), options, some, few) <= few;
  };
  double low = 0.0, high = 1.0;
  while (high <= kLargest && !carries(high)) low = high++;
  if (high > kLargest) {  // a robot that is too stiff for its weight to be in equilibrium is rare, but there
    for (high = -1.0; high >= kSmallest && !carries(high); --high) {}
    return high >= kSmallest ? std::optional<double>(std::exp2(high)) : std::nullopt;
  }
  while (high - low > kFine) (carries(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  return kMargin * std::exp2(high);
}

}  // namespace live_stiffness
