// StaticsSolver: from a guess to an equilibrium for one load, and its tangent.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "rod/statics.h"

namespace live_stiffness {
namespace {

constexpr double kResidualGoal = 1e-12;     // rad, see StaticsReport::residual
constexpr double kResidualAccepted = 1e-8;  // rad, if rounding prevents the goal; part of the error estimate
constexpr double kCoarseSensitivities = 1e-2;      // relative error with which quasi-Newton iterations converge
constexpr double kFineSensitivities = 1e-12;      // for Newton steps where the derivative is nearly singular, or huge
constexpr double kLargestBucklingFactor = 1e6;
constexpr double kSlowSweeps = 0.3;         // convergence rate above which new sensitivities are worth their cost
constexpr double kQuickestRate = 0.01;      // smallest convergence rate that the stopping rule assumes

}  // namespace

bool StaticsSolver::integrateChain(const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone, Vector3& residual) {
  nodes_hold_guess_ = shoot(chain_, loads, base_moment, nodes_hold_guess_, backbone, residual);
  return nodes_hold_guess_;
}

bool StaticsSolver::updateInverse(const DeadLoads& loads, double goal, Backbone& backbone) {
  ElementSensitivities columns;
  const double change =
      tipSensitivities(chain_, loads, !has_sensitivities_, goal, backbone, columns, false, SensitivitySet::kBaseMoment);
  has_sensitivities_ = std::isfinite(change);
  residual_inverse_ = sensitivityMatrix(columns.m).leftCols<3>().inverse();
  return has_sensitivities_ && residual_inverse_.allFinite();
}

// Quasi-Newton: in each iteration one fixed-point iteration of each element, then a step of the base moment with the inverse
// kept. Shape and moment converge together, by a factor of about ten each time; usually one to ten iterations are enough.
// If the shape has moved too far from that of the sensitivities, these are computed again.
bool StaticsSolver::chordIteration(const DeadLoads& loads, Known known, int max_sweeps, Backbone& backbone,
                          StaticsReport& report) {
  const int sweeps_before_sensitivities = known == Known::kNone ? 2 : 0;
  bool has_sensitivities = known == Known::kSensitivities;
  constexpr double kRounding = 1e-13;
  const double goal = std::max(0.2 * accuracy_ / buckling_factor_, 1e-15);
  if (known == Known::kNone) residual_inverse_.setIdentity();  // exact without loads
  double last = kInfinity;
  int growing = 0, last_sensitivities = 0;
  ChainState chain = stateOf(chain_, loads, base_moment_, backbone);
  SweepResult s;
  for (int i = 0; i < max_sweeps && report.iterations < kMaxIterations; ++i) {
    ++report.iterations;
    backbone.kernel->sweep(chain, nodes_hold_guess_ ? SweepMode::kOnce : SweepMode::kCold, s);
    nodes_hold_guess_ = s.is_admissible;
    const double error = std::max(s.change, bendingOf(Vector3(s.residual)));
    if (!s.is_admissible || (growing += error > last) > 3) return false;
    // Two iterations give a rate. Within two digits of the goal a few more are cheaper than new sensitivities.
    const bool is_slow = has_sensitivities && i >= last_sensitivities + 2 && error > kSlowSweeps * last && error > 100.0 * goal;
    if (is_slow || (!has_sensitivities && i >= sweeps_before_sensitivities)) {
      last_sensitivities = i;
      SweepResult unchanged;
      backbone.kernel->sweep(chain, SweepMode::kShape, unchanged);
      if (!(has_sensitivities = updateInverse(loads, kCoarseSensitivities, backbone))) return false;
    }
    const Vector3 step = -residual_inverse_ * Vector3(s.residual);
    base_moment_ += step;
    for (int k = 0; k < 3; ++k) chain.base_moment[k] = base_moment_[k];
    if (has_sensitivities) backbone.kernel->follow_all(chain, {step.x(), step.y(), step.z()});
    // One iteration gives no rate; then that of the last solve is used, with a lower limit.
    if (i > 0) rate_ = std::max(kQuickestRate, std::min(kSlowestRate, error / last));  // 0 / 0: kSlowestRate
    const double rate = i > 0 ? rate_ : std::max(rate_, 0.5 * kSlowestRate);
    const bool at_rounding = error <= kRounding && error > 0.3 * last;
    report.iteration = at_rounding ? error : rate * error;
    last = error;
    if (!has_sensitivities || (report.iteration > goal && !at_rounding)) continue;
    backbone.kernel->sweep(chain, SweepMode::kShape, s);
    report.residual = bendingOf(Vector3(s.residual));
    if (!(report.residual <= goal) && !at_rounding) continue;
    backbone.setTip(s.R_tip, s.p_tip);
    return true;
  }
  return false;
}

bool StaticsSolver::newton(const DeadLoads& loads, Backbone& backbone, int max_iterations, StaticsReport& report) {
  Vector3 m0 = base_moment_, accepted_m0 = m0, residual = Vector3::Zero();
  Vector3 step = residual, accepted_residual = residual;
  double accepted = kInfinity, damping = 1.0;
  bool have_inverse = warm_, inverse_is_fresh = false;
  const auto refresh = [&] {
    have_inverse = inverse_is_fresh = updateInverse(loads, kFineSensitivities, backbone);
  };
  for (int i = 0; i < max_iterations && report.iterations < kMaxIterations; ++i) {
    ++report.iterations;
    const bool integrated = integrateChain(loads, m0, backbone, residual);
    report.residual = integrated ? bendingOf(residual) : kInfinity;
    const bool stalled = report.residual <= kResidualAccepted && report.residual >= 0.5 * accepted && inverse_is_fresh;
    if (report.residual <= kResidualGoal || stalled) {
      report.iteration = 0.0;  // shoot() has converged to rounding
      base_moment_ = m0;
      return true;
    }
    if (report.residual < accepted) {
      if (have_inverse && std::isfinite(accepted)) {
        // Broyden's update: afterwards the inverse maps the last change of the residual to the last step.
        const Vector3 change = residual_inverse_ * (residual - accepted_residual);
        const Vector3 made = m0 - accepted_m0;
        const double scale = made.dot(change);
        if (std::abs(scale) > 1e-3 * made.squaredNorm())
          residual_inverse_ += (made - change) * (made.transpose() * residual_inverse_) / scale;
      }
      if (!have_inverse || (report.residual > 0.1 * accepted && !stalled)) refresh();
      else inverse_is_fresh = false;
      accepted = report.residual;
      accepted_m0 = m0;
      accepted_residual = residual;
      damping = 1.0;
    } else if (std::isinf(accepted)) {
      return false;  // even the first guess cannot be integrated
    } else if (!inverse_is_fresh) {
      if (!integrateChain(loads, accepted_m0, backbone, residual)) return false;
      refresh();
      damping = 1.0;
    } else {
      damping *= 0.5;
      if (damping < 1e-2) return false;
      m0 = accepted_m0 + damping * step;
      continue;
    }
    step = -residual_inverse_ * residual;
    if (!step.allFinite()) return false;
    m0 = accepted_m0 + damping * step;
  }
  return false;
}

// Sensitivities with a relative error x give a compliance with an error of about x. But without a tip moment the linearised
// rod is its own adjoint, so that error is known to first order: the adjoint-weighted residual. When it is subtracted, an
// error of about x^2 remains. See docs/derivation.md, section 5.
//
// On a long chain under tension, and near a fold, the sensitivities are far larger than the compliance, which is a difference
// of them. Then x and rounding grow by that ratio.
bool StaticsSolver::findTangent(const DeadLoads& loads, Backbone& backbone, StaticsReport& report, SensitivitySet set) {
  const double rounding = 2e-16 * static_cast<double>(backbone.elements.size());  // upper bound for sums over all elements
  constexpr double kEnough = 2.0;  // the growth is known only afterwards; below this factor no second attempt is made
  const double goal = 0.2 * accuracy_, shape = report.iteration;
  const bool self_adjoint = angular(loads.tip).isZero(0.0);
  double cancellation = 1.0, growth_squared = 1.0;  // of the linear sensitivities, and of all
  for (int attempt = 0; attempt < 2; ++attempt) {
    ElementSensitivities tip;
    const double error_goal = std::max(goal / buckling_factor_, 1e-16);
    const double sensitivity_goal = self_adjoint ? std::sqrt(2.0 * error_goal / (buckling_factor_ * growth_squared))
                                            : error_goal / cancellation;
    const double change =
        tipSensitivities(chain_, loads, !has_sensitivities_, sensitivity_goal, backbone, tip, self_adjoint, set);
    has_sensitivities_ = std::isfinite(change);
    if (!has_sensitivities_) return false;
    backbone.kernel->tangent(tip, self_adjoint, residual_inverse_.data(), tangent_.data());
    if (!std::isfinite(tangent_.sum())) return false;
    buckling_factor_ =
        std::clamp(tangent_.diagonal().tail<3>().cwiseAbs().maxCoeff() / stiffest_, 1.0, kLargestBucklingFactor);
    const double p = sensitivityMatrix(tip.p).rightCols<3>().squaredNorm(),
                 m = sensitivityMatrix(tip.m).leftCols<3>().squaredNorm(),
                 phi = sensitivityMatrix(tip.phi).leftCols<3>().squaredNorm(), inverse = residual_inverse_.squaredNorm();
    const double linear_part = std::max(1.0, p / tangent_.topLeftCorner<3, 3>().squaredNorm());
    // Without loads both are 1. Towards a bifurcation the condition number grows as the buckling factor, which is included
    // already.
    const double angular_part = phi * inverse / (3.0 * tangent_.bottomRightCorner<3, 3>().squaredNorm());
    const double condition = m * inverse / (9.0 * buckling_factor_ * buckling_factor_);
    cancellation = std::sqrt(linear_part);
    growth_squared = std::max(linear_part, angular_part);
    const double left =
        self_adjoint ? 0.5 * change * change * growth_squared * buckling_factor_ : change * cancellation;
    report.iteration = shape + left;
    report.rounding = rounding * std::sqrt(growth_squared * std::max(1.0, condition));
    report.truncation = discretisation_.truncation(cancellation, backbone);
    if (left * buckling_factor_ <= kEnough * goal) break;
  }
  report.buckling_factor = buckling_factor_;
  return true;
}

}  // namespace live_stiffness
