#include "benchmark/methods/base_moment_shooting.h"

#include <Eigen/LU>

namespace live_stiffness {

BaseMomentShooting::BaseMomentShooting(std::string name, const Scene& scene)
    : StiffnessMethod(std::move(name)), chain_(scene) {}

// tip.m is the residual: no tip wrench acts.
bool BaseMomentShooting::shoot(RodState& tip) {
  tip = {{}, chain_.weight(), base_moment_};
  int index = 0;
  for (const auto& piece : chain_.pieces()) {
    if (const auto* soft = std::get_if<SoftPiece>(&piece)) {
      if (!integrate(index++, *soft, tip)) return false;
    } else {
      carry(std::get<RigidPiece>(piece), tip);
    }
  }
  return tip.m.allFinite();
}

bool BaseMomentShooting::shootWithColumns(Tip& tip) {
  tip = {{{}, chain_.weight(), base_moment_}, {}, {}};
  int index = 0;
  for (const auto& piece : chain_.pieces()) {
    if (const auto* soft = std::get_if<SoftPiece>(&piece)) {
      if (!integrate(index++, *soft, tip.state, tip.columns, tip.sum)) return false;
    } else {
      carry(std::get<RigidPiece>(piece), tip.state, tip.columns);
      carry(std::get<RigidPiece>(piece), tip.state);
    }
  }
  return tip.state.m.allFinite();
}

// Stops where the columns' pass in finish(), which removes the last residual to first order, leaves less than 1e-12.
bool BaseMomentShooting::newton(bool fresh_jacobians) {
  constexpr double kGoal = 1e-9;  // rad
  const double softness = chain_.softness();
  double last = 1e300;
  Vector3 last_residual = Vector3::Zero(), step = Vector3::Zero();
  for (int iteration = 0; iteration < 30; ++iteration) {
    Tip tip;
    if (!(fresh_jacobians ? shootWithColumns(tip) : shoot(tip.state))) return false;
    const Vector3& residual = tip.state.m;
    const double size = softness * residual.norm();
    if (fresh_jacobians) inverse_ = tip.columns.m.leftCols<3>().inverse();
    if (size < kGoal) return true;
    if (!(size < 2.0 * last)) return false;
    if (!fresh_jacobians && iteration > 0) {  // Broyden's update
      const Vector3 change = inverse_ * (residual - last_residual);
      const double scale = step.dot(change);
      if (std::abs(scale) > 1e-3 * step.squaredNorm())
        inverse_ += (step - change) * (step.transpose() * inverse_) / scale;
    }
    step = -inverse_ * residual;
    base_moment_ += step;
    last = size;
    last_residual = residual;
  }
  return false;
}

StiffnessSolution BaseMomentShooting::finish() {
  StiffnessSolution solution;
  solution.status = statusOf(false);
  Tip tip;
  if (!shootWithColumns(tip)) return solution;
  const RodColumns& d = tip.columns;
  inverse_ = d.m.leftCols<3>().inverse();
  const Vector3 step = -inverse_ * tip.state.m;
  base_moment_ += step;
  const Matrix3 m0_of_force = -inverse_ * d.m.rightCols<3>();
  solution.X_BT.p = tip.state.X.p + d.p.leftCols<3>() * step;
  solution.X_BT.R = expSo3(d.phi.leftCols<3>() * step) * tip.state.X.R;
  solution.compliance << d.p.rightCols<3>() + d.p.leftCols<3>() * m0_of_force, d.p.leftCols<3>() * inverse_,
      d.phi.rightCols<3>() + d.phi.leftCols<3>() * m0_of_force, d.phi.leftCols<3>() * inverse_;
  solution.material_compliance = tip.sum.about(tip.state.X.p);
  solution.status = statusOf(solution.compliance.allFinite());
  return solution;
}

StiffnessSolution BaseMomentShooting::solve(PressuresRef pressures) {
  StiffnessSolution solution;
  solution.status = statusOf(false);
  if (!chain_.setPressures(pressures)) return solution;
  bool converged = warm_ && newton(false);
  if (!converged) {
    forget();
    base_moment_ = chain_.unloadedBaseMoment();
    converged = newton(true);
  }
  if (converged) solution = finish();
  warm_ = solution.status.ok();
  return solution;
}

}  // namespace live_stiffness
