// StaticsSolver: from a guess to an equilibrium, and its tangent.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "rod/stability.h"
#include "rod/statics.h"

namespace live_stiffness {
namespace {

constexpr double kQuickestRate = 0.01;         // smallest convergence rate that the stopping rule assumes
constexpr double kCoarseSensitivities = 1e-2;  // relative error with which quasi-Newton iterations converge
constexpr double kSlow = 0.3;                  // convergence rate above which new sensitivities are worth their cost
constexpr double kJump = 0.7;                  // rad; error of a warm start from which a cold one is faster
constexpr int kMostGrowing = 3;                // iterations that may be worse than the one before
constexpr double kRefinable = 1e-3;            // rad; error at which a shape shows how many elements it needs
constexpr double kMostTurn = 0.7;              // rad, of a section in a step
constexpr double kLargestBucklingFactor = 1e6;

// The symmetric part is; a dead moment has no potential, so the second variation alone does not show stability.
bool isPositiveDefinite(const Matrix6& C) { return Matrix6(C + C.transpose()).llt().info() == Eigen::Success; }

}  // namespace

// The elements must have been evaluated.
bool StaticsSolver::linearise(const DeadLoads& loads, Linearisation how, Backbone& backbone, LinearisationResult& result) {
  how.cold = !has_sensitivities_;
  result = backbone.kernel->linearise(stateOf(chain_, loads, Vector3::Zero(), backbone), how);
  return has_sensitivities_ = std::isfinite(result.left);
}

// Quasi-Newton: in each iteration one fixed-point iteration of each element, then a step of all start values with the
// sensitivities kept. Shape and moments converge together, by a factor of about ten each time; usually one to ten iterations
// are enough. If the shape has moved too far from that of the sensitivities, these are computed again.
bool StaticsSolver::converge(Start start, const DeadLoads& loads, int most_iterations, Backbone& backbone,
                             StaticsReport& report) {
  constexpr double kRounding = 1e-13, kStalled = 1e-8;  // rad
  constexpr int kMostStalled = 3;
  const double goal = std::max(0.2 * accuracy_ / buckling_factor_, 1e-15);
  const ChainState chain = stateOf(chain_, loads, Vector3::Zero(), backbone);
  double last = kInfinity, last_left = kInfinity;
  int growing = 0, stalled = 0, last_sensitivities = 0;
  bool may_refine = start != Start::kWarm;
  IterationResult now;
  for (int i = 0; i < most_iterations && report.iterations < kMaxIterations; ++i) {
    ++report.iterations;
    backbone.kernel->iterate_all(chain, now);
    const double error = std::max({now.change, now.turn, bendingOf(now.moment)});
    const bool jumped = start == Start::kWarm && i == 0 && error > kJump;
    if (jumped || !now.is_admissible || (growing += error > last && error > kStalled) > kMostGrowing)
      return false;
    // Two iterations give a rate. Within two digits of the goal a few more are cheaper than new sensitivities.
    const bool is_slow = i >= last_sensitivities + 2 && error > kSlow * last && error > 100.0 * goal;
    if (is_slow || !has_sensitivities_) {
      last_sensitivities = i;
      LinearisationResult ignored;
      backbone.kernel->evaluate_all(chain);
      if (!linearise(loads, {kCoarseSensitivities}, backbone, ignored)) return false;
    }
    // What the step turns the sections by is what the gaps along the whole chain amount to.
    const double left = std::max(error, backbone.kernel->correct(chain, now, kMostTurn));
    if (may_refine && error < kRefinable) {
      may_refine = false;
      backbone.kernel->evaluate_all(chain);
      if (discretisation_.refine(buckling_factor_, backbone)) {
        rebuild(loads, backbone);
        return converge(start, loads, most_iterations, backbone, report);
      }
    }
    // One iteration gives no rate; then that of the last solve is used, with a lower limit.
    if (i > 0) rate_ = std::max(kQuickestRate, std::min(kSlowestRate, left / last_left));  // 0 / 0: kSlowestRate
    const double rate = i > 0 ? rate_ : std::max(rate_, 0.5 * kSlowestRate);
    // Rounding grows with the number of elements; what it leaves is part of the estimate.
    stalled += error > 0.3 * last && error < kStalled;
    const bool at_rounding = (error <= kRounding && error > 0.3 * last) || stalled > kMostStalled;
    report.iteration = at_rounding ? left : rate * left;
    last = error;
    last_left = left;
    if (report.iteration > goal && !at_rounding) continue;
    const MarchResult end = march(chain_, loads, Vector3::Zero(), MarchMode::kClose, backbone);
    report.residual = bendingOf(end.gap);
    if (report.residual <= goal || at_rounding) return true;
  }
  return false;
}

// Sensitivities with a relative error x give a compliance with an error of about x. But without a tip moment the linearised
// rod is its own adjoint, so that error is known to first order: the adjoint-weighted residual. When it is subtracted, an
// error of about x^2 remains. See docs/derivation.md, section 5.
bool StaticsSolver::findTangent(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  constexpr double kEnough = 2.0;  // the buckling factor is known only afterwards; below this no second attempt is made
  const double goal = 0.2 * accuracy_, shape = report.iteration;
  const bool self_adjoint = angular(loads.tip).isZero(0.0);
  const int count = static_cast<int>(backbone.elements.size());
  LinearisationResult result;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const double error_goal = std::max(goal / buckling_factor_, 1e-16);
    const double sensitivity_goal = self_adjoint ? std::sqrt(2.0 * error_goal / buckling_factor_) : error_goal;
    Linearisation how{sensitivity_goal};
    how.with_force = true;
    how.with_adjoint = self_adjoint;
    if (!linearise(loads, how, backbone, result)) return false;
    backbone.kernel->tangent(&backbone.elements[0].state, count, self_adjoint, tangent_.data());
    if (!std::isfinite(tangent_.sum())) return false;
    buckling_factor_ =
        std::clamp(tangent_.diagonal().tail<3>().cwiseAbs().maxCoeff() / stiffest_, 1.0, kLargestBucklingFactor);
    const double left = self_adjoint ? 0.5 * result.left * result.left * buckling_factor_ : result.left;
    report.iteration = shape + left;
    if (left * buckling_factor_ <= kEnough * goal) break;
  }
  report.rounding = 2e-16 * count;  // upper bound for sums over all elements
  report.truncation = discretisation_.truncation(backbone);
  report.buckling_factor = buckling_factor_;
  const double rotation = tangent_.bottomRightCorner<3, 3>().trace();
  report.neutral = result.unstable == 0 && isNeutral(rotation / most_compliant_, report.relativeError());
  report.stable = result.unstable == 0 && !report.neutral && (self_adjoint || isPositiveDefinite(tangent_));
  return true;
}

}  // namespace live_stiffness
