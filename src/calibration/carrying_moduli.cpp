#include "calibration/carrying_moduli.h"

#include <cmath>
#include <limits>

#include "calibration/scene_parameter.h"
#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/estimation/registration_fit.h"

namespace live_stiffness {
namespace {

// Mean square of the distances that are left when each recording is registered, m^2; infinite if fewer than three samples of
// one have an equilibrium.
double misfit(const Scene& scene, const ModelOptions& options, const std::vector<SamplesToCarry>& samples) {
  const StiffnessModel model(scene, options);
  double sum = 0.0;
  for (const SamplesToCarry& some : samples) {
    StiffnessWorkspace workspace = model.makeWorkspace();
    std::vector<Pose> X_BT, X_AS;
    for (size_t i = 0; i < some.X_AS.size(); ++i) {
      const StiffnessSolution solution = model.solve(some.pressures[i], Wrench::Zero(), workspace);
      if (!solution.status.ok()) continue;
      X_BT.push_back(solution.X_BT);
      X_AS.push_back(some.X_AS[i]);
    }
    if (some.X_AS.empty()) continue;
    if (X_BT.size() < 3) return std::numeric_limits<double>::infinity();
    const double rms = fitRegistration(X_BT, X_AS).position.rms;
    sum += rms * rms;
  }
  return sum;
}

}  // namespace

long withoutEquilibrium(const Scene& scene, const ModelOptions& options, const std::vector<SamplesToCarry>& samples, long most) {
  const StiffnessModel model(scene, options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  long count = 0;
  for (const SamplesToCarry& some : samples)
    for (const Pressures& pressures : some.pressures) {
      if (model.solve(pressures, Wrench::Zero(), workspace).status.ok()) continue;
      if (++count > most) return count;
      workspace = model.makeWorkspace();
    }
  return count;
}

std::optional<double> carryingFactor(const Scene& scene, const ModelOptions& options,
                                     const std::vector<SamplesToCarry>& samples) {
  constexpr int kLargest = 14, kSmallest = -7;  // powers of 2
  constexpr double kFine = 0.25;                // of a power of 2
  size_t count = 0;
  for (const SamplesToCarry& some : samples) count += some.pressures.size();
  const auto few = static_cast<long>(kFewShare * static_cast<double>(count));
  const auto carries = [&](double power) {
    return withoutEquilibrium(withModuliTimes(scene, std::exp2(power)), options, samples, few) <= few;
  };
  double low = 0.0, high = 1.0;
  while (high <= kLargest && !carries(high)) low = high++;
  if (high > kLargest) {
    for (high = -1.0; high >= kSmallest && !carries(high); --high) {}
    return high >= kSmallest ? std::optional<double>(std::exp2(high)) : std::nullopt;
  }
  while (high - low > kFine) (carries(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  double best = 1.25 * std::exp2(high), least = std::numeric_limits<double>::infinity();
  for (double beyond : {1.25, 1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0}) {
    const double factor = beyond * std::exp2(high), error = misfit(withModuliTimes(scene, factor), options, samples);
    if (error < least) least = error, best = factor;
  }
  return best;
}

}  // namespace live_stiffness
