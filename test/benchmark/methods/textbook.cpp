#include "benchmark/methods/textbook.h"

#include <Eigen/Geometry>

#include "benchmark/methods/levenberg_marquardt.h"
#include "benchmark/methods/material_sum.h"

namespace live_stiffness {
namespace {

using Eigen::VectorXd;

VectorXd packed(const RodState& state) {
  VectorXd y(18);
  y << state.X.p, Eigen::Map<const VectorXd>(state.X.R.data(), 9), state.n, state.m;
  return y;
}

RodState unpacked(const VectorXd& y) {
  return {{Eigen::Map<const Matrix3>(y.data() + 3), y.head(3)}, y.segment(12, 3), y.tail(3)};
}

VectorXd rate(const SoftPiece& piece, const VectorXd& y) {
  const Matrix3 R = Eigen::Map<const Matrix3>(y.data() + 3);
  const Vector3 n = y.segment<3>(12), m = y.tail<3>();
  const Vector3 v = Vector3::UnitZ() + piece.rest.c.shear_elongation * (R.transpose() * n);
  const Vector3 u = piece.rest.curvature + piece.rest.c.bending_torsion * (R.transpose() * m);
  VectorXd dy(18);
  dy.head<3>() = R * v;
  Eigen::Map<Matrix3>(dy.data() + 3) = R * hat(u);
  dy.segment<3>(12) = -piece.line_load;
  dy.tail<3>() = n.cross(dy.head<3>());
  return dy;
}

}  // namespace

Textbook::Textbook(const Scene& scene, int steps)
    : StiffnessMethod("RK4 N=" + std::to_string(steps) + ", finite differences, dynamic matrices"),
      chain_(scene), steps_(steps) {}

Textbook::States Textbook::shoot(const VectorXd& base_wrench) const {
  VectorXd y = packed({{}, base_wrench.head(3), base_wrench.tail(3)});
  States states;
  for (const auto& piece : chain_.pieces()) {
    if (const auto* soft = std::get_if<SoftPiece>(&piece)) {
      const double h = soft->length / steps_;
      states.push_back(y);
      for (int i = 0; i < steps_; ++i) {
        const VectorXd k1 = rate(*soft, y);
        const VectorXd k2 = rate(*soft, y + 0.5 * h * k1);
        const VectorXd k3 = rate(*soft, y + 0.5 * h * k2);
        const VectorXd k4 = rate(*soft, y + h * k3);
        y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        states.push_back(y);
      }
    } else {
      RodState state = unpacked(y);
      carry(std::get<RigidPiece>(piece), state);
      y = packed(state);
    }
  }
  states.push_back(y);
  return states;
}

VectorXd Textbook::residual(const VectorXd& tip, const VectorXd& tip_wrench) const {
  VectorXd result = tip.tail(6) - tip_wrench;
  result.tail(3) /= chain_.length();
  return result;
}

bool Textbook::iterate(const VectorXd& tip_wrench, VectorXd& base_wrench, States& states) const {
  constexpr double kTolerance = 1e-11;  // N
  const auto shot = [&](const VectorXd& guess) {
    states = shoot(guess);
    return residual(states.back(), tip_wrench);
  };
  return levenbergMarquardt(shot, kTolerance, base_wrench);
}

StiffnessSolution Textbook::solve(PressuresRef pressures) {
  StiffnessSolution solution;
  solution.status = statusOf(false);
  if (!chain_.setPressures(pressures)) return solution;
  if (base_wrench_.size() == 0) base_wrench_ = (VectorXd(6) << chain_.weight(), Vector3::Zero()).finished();
  States states, bent_states;
  bool converged = iterate(VectorXd::Zero(6), base_wrench_, states);
  const RodState tip = unpacked(states.back());
  solution.X_BT = tip.X;
  for (int i = 0; i < 6 && converged; ++i) {
    const double step = i < 3 ? 1e-5 : 1e-5 * chain_.length();
    VectorXd tip_wrench = VectorXd::Zero(6), base_wrench = base_wrench_;
    tip_wrench[i] = step;
    converged = iterate(tip_wrench, base_wrench, bent_states);
    const RodState bent = unpacked(bent_states.back());
    solution.compliance.col(i).head<3>() = (bent.X.p - tip.X.p) / step;
    solution.compliance.col(i).tail<3>() = logSo3(bent.X.R * tip.X.R.transpose()) / step;
  }
  MaterialSum sum;
  auto state = states.begin();
  for (const auto& piece : chain_.pieces())
    if (const auto* soft = std::get_if<SoftPiece>(&piece))
      for (int i = 0; i <= steps_; ++i, ++state)
        sum.add(unpacked(*state).X, soft->rest.c, soft->length * simpsonWeight(i, steps_));
  solution.material_compliance = sum.about(tip.X.p);
  if (!converged) reset();
  solution.status = statusOf(converged);
  return solution;
}

}  // namespace live_stiffness
