#include "benchmark/methods/common_practice.h"

#include <Eigen/LU>

#include "benchmark/methods/levenberg_marquardt.h"
#include "benchmark/methods/material_sum.h"

namespace live_stiffness {
namespace {

// Forward differences: truncation grows with the step, rounding and the tolerance over it. Measured on the paper's
// one and two segments, the compliance is best (1e-7 and 2e-6) at this step.
constexpr double kJacobianStep = 1e-6;    // N, and N times the length
constexpr double kComplianceStep = 3e-7;  // N, and N times the length
constexpr double kTolerance = 1e-12;      // N

}  // namespace

CommonPractice::CommonPractice(const Scene& scene, Jacobians jacobians, int steps)
    : StiffnessMethod("RK4 N=" + std::to_string(steps) + ", finite differences" +
                      (jacobians == Jacobians::kReused ? ", one Jacobian" : "") +
                      (jacobians == Jacobians::kDamped ? ", Levenberg" : "")),
      chain_(scene), jacobians_(jacobians), steps_(steps) {}

Vector6 CommonPractice::shoot(const Vector6& base_wrench, const Wrench& tip_wrench, RodState& tip) const {
  tip = {{}, linear(base_wrench), angular(base_wrench)};
  Rk4Stages stages;
  for (const auto& piece : chain_.pieces()) {
    if (const auto* soft = std::get_if<SoftPiece>(&piece))
      for (int i = 0; i < steps_; ++i) rk4Step(*soft, soft->length / steps_, tip, stages);
    else carry(std::get<RigidPiece>(piece), tip);
  }
  Vector6 residual;
  linear(residual) = tip.n - linear(tip_wrench);
  angular(residual) = (tip.m - angular(tip_wrench)) / chain_.length();
  return residual;
}

void CommonPractice::findJacobian(const Vector6& base_wrench, const Wrench& tip_wrench, const Vector6& residual) {
  Matrix6 jacobian;
  RodState unused;
  for (int i = 0; i < 6; ++i) {
    const double step = i < 3 ? kJacobianStep : kJacobianStep * chain_.length();
    jacobian.col(i) = (shoot(base_wrench + step * Vector6::Unit(i), tip_wrench, unused) - residual) / step;
  }
  inverse_jacobian_ = jacobian.inverse();
}

// Newton's method (with the Jacobian as it is unless fresh ones are asked for), or Levenberg's.
bool CommonPractice::iterate(const Wrench& tip_wrench, Vector6& base_wrench, RodState& tip, bool fresh_jacobians) {
  if (jacobians_ == Jacobians::kDamped)
    return levenbergMarquardt([&](const Vector6& guess) { return shoot(guess, tip_wrench, tip); }, kTolerance, base_wrench);
  double last = 1e300;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Vector6 residual = shoot(base_wrench, tip_wrench, tip);
    const double size = residual.norm();
    if (size < kTolerance) return true;
    if (!(size < last)) return size < 100.0 * kTolerance;  // rounding
    if (fresh_jacobians) findJacobian(base_wrench, tip_wrench, residual);
    base_wrench -= inverse_jacobian_ * residual;
    last = size;
  }
  return false;
}

StiffnessSolution CommonPractice::solve(PressuresRef pressures) {
  StiffnessSolution solution;
  solution.status = statusOf(false);
  if (!chain_.setPressures(pressures)) return solution;
  const bool reuse = jacobians_ == Jacobians::kReused;
  RodState tip, bent;
  bool converged = warm_ && iterate(Wrench::Zero(), base_wrench_, tip, !reuse);
  if (!converged) {
    linear(base_wrench_) = chain_.weight();
    angular(base_wrench_) = chain_.unloadedBaseMoment();
    converged = iterate(Wrench::Zero(), base_wrench_, tip, true);
  }
  warm_ = converged;
  if (!converged) return solution;
  solution.X_BT = tip.X;
  if (reuse) {
    Vector6 residual;
    linear(residual) = tip.n;
    angular(residual) = tip.m / chain_.length();
    findJacobian(base_wrench_, Wrench::Zero(), residual);
  }
  for (int i = 0; i < 6; ++i) {
    const double step = i < 3 ? kComplianceStep : kComplianceStep * chain_.length();
    Vector6 base_wrench = base_wrench_;
    if (reuse) base_wrench += kComplianceStep * inverse_jacobian_.col(i);  // the residual is known without a shot
    converged = iterate(step * Wrench::Unit(i), base_wrench, bent, !reuse) && converged;
    solution.compliance.col(i).head<3>() = (bent.X.p - tip.X.p) / step;
    solution.compliance.col(i).tail<3>() = logSo3(bent.X.R * tip.X.R.transpose()) / step;
  }
  solution.material_compliance = materialCompliance(base_wrench_);
  solution.status = statusOf(converged);
  return solution;
}

Matrix6 CommonPractice::materialCompliance(const Vector6& base_wrench) const {
  RodState state{{}, linear(base_wrench), angular(base_wrench)};
  Rk4Stages stages;
  MaterialSum sum;
  for (const auto& piece : chain_.pieces()) {
    if (const auto* soft = std::get_if<SoftPiece>(&piece)) {
      for (int i = 0; i <= steps_; ++i) {
        sum.add(state.X, soft->rest.c, soft->length * simpsonWeight(i, steps_));
        if (i < steps_) rk4Step(*soft, soft->length / steps_, state, stages);
      }
    } else {
      carry(std::get<RigidPiece>(piece), state);
    }
  }
  return sum.about(state.X.p);
}

}  // namespace live_stiffness
