#include "support/chain_energy.h"

#include <Eigen/LU>

#include <cmath>

namespace live_stiffness {
namespace {

// Derivative by w of (I - sign/2 hat(w) + d hat(w)^2) a: a by the transposed inverse of the right (sign 1) or left (-1)
// Jacobian of the exponential.
Matrix3 derivativeOfInverse(const Vector3& w, const Vector3& a, double sign) {
  constexpr double kStep = 1e-3;  // rad^2, of the difference for d'(x)
  const double x = w.squaredNorm(), d = angleD(x), slope = (angleD(x + kStep) - angleD(x - kStep)) / (2.0 * kStep);
  return 0.5 * sign * hat(a) + d * (w.dot(a) * Matrix3::Identity() + w * a.transpose() - 2.0 * a * w.transpose()) +
         2.0 * slope * w.cross(w.cross(a)) * w.transpose();
}

}  // namespace

NodeRotations turned(NodeRotations R, double factor, const NodeVectors& turns) {
  for (size_t i = 1; i < R.size(); ++i) R[i] = orthonormalised(R[i] * expSo3(factor * turns[i]));
  return R;
}

ChainEnergy::ChainEnergy(const Scene& scene, const std::vector<RestState>& rest, const Vector3& tip_force, int n) {
  const Vector3 gravity = scene.gravity.value_or(Vector3::Zero());
  Vector3 force = tip_force + scene.tip_mass * gravity;
  walk(
      scene, [&](int, const Segment& segment) { force += segment.mass() * gravity; },
      [&](const Link& link) { force += link.mass * gravity; });
  walk(
      scene,
      [&](int k, const Segment& segment) {
        const double h = rest[k].stretch * segment.length / n;
        const Vector3 half_arm = 0.5 * h * Vector3::UnitZ();
        const Matrix3 half_give = 0.5 * h * rest[k].c.shear_elongation;
        for (int i = 0; i < n; ++i) {
          levers_.push_back({intervals_.size(), force, half_arm, half_give});
          intervals_.push_back({rest[k].c.bending_torsion.inverse() / h, h * rest[k].curvature});
          force -= segment.mass() / n * gravity;
          levers_.push_back({intervals_.size(), force, half_arm, half_give});
        }
        body_ends_.push_back(levers_.size());
      },
      [&](const Link& link) {
        const Vector3 arm = link.length * Vector3::UnitZ(), weight = link.mass * gravity;
        levers_.push_back({intervals_.size(), force - 0.5 * weight, arm, Matrix3::Zero()});
        force -= weight;
        body_ends_.push_back(levers_.size());
      });
  levers_.push_back({intervals_.size(), force, scene.tip_offset, Matrix3::Zero()});
}

NodeRotations ChainEnergy::unloaded() const {
  NodeRotations R(1, Matrix3::Identity());
  for (const Interval& interval : intervals_) R.push_back(orthonormalised(R.back() * expSo3(interval.rest)));
  return R;
}

double ChainEnergy::value(const NodeRotations& R, double* uncertainty) const {
  double energy = 0.0, sum = 0.0;
  const auto add = [&](double part) { energy += part, sum += std::abs(part); };
  for (size_t i = 0; i < intervals_.size(); ++i) {
    const Vector3 bent = logSo3(R[i].transpose() * R[i + 1]) - intervals_[i].rest;
    add(0.5 * bent.dot(intervals_[i].stiffness * bent));
    sum += intervals_[i].stiffness.norm() * (0.01 * bent.norm() + 1e-16);  // of the angle, which is not small itself
  }
  for (const Lever& lever : levers_) {
    const Vector3 N = lever.forceIn(R);
    add(-N.dot(lever.arm + 0.5 * lever.give * N));
  }
  if (uncertainty) *uncertainty = 1e-14 * sum;
  return energy;
}

EnergyDerivatives ChainEnergy::derivatives(const NodeRotations& R) const {
  const size_t nodes = R.size();
  EnergyDerivatives result{NodeVectors(nodes, Vector3::Zero()), BlockTridiagonal(nodes), BlockTridiagonal(nodes)};
  BlockTridiagonal &second = result.second, &material = result.material;
  for (size_t i = 0; i < intervals_.size(); ++i) {
    const Matrix3& K = intervals_[i].stiffness;
    const Vector3 w = logSo3(R[i].transpose() * R[i + 1]), moment = K * (w - intervals_[i].rest);
    const Matrix3 W = hat(w), even = Matrix3::Identity() + angleD(w.squaredNorm()) * W * W;
    const Matrix3 to = even + 0.5 * W, from = -(even - 0.5 * W);  // of w by the turns of nodes i + 1 and i
    const Matrix3 bend = derivativeOfInverse(w, moment, 1.0);
    result.gradient[i] += from.transpose() * moment;
    result.gradient[i + 1] += to.transpose() * moment;
    material.diagonal[i] += from.transpose() * K * from;
    material.diagonal[i + 1] += to.transpose() * K * to;
    material.below[i] += to.transpose() * K * from;
    second.diagonal[i] -= derivativeOfInverse(w, moment, -1.0) * from;
    second.diagonal[i + 1] += bend * to;
    second.below[i] += bend * from;
  }
  for (const Lever& lever : levers_) {
    const Vector3 N = lever.forceIn(R), reach = lever.reach(R);
    result.gradient[lever.node] += N.cross(reach);
    second.diagonal[lever.node] += reach.dot(N) * Matrix3::Identity() - reach * N.transpose() -
                                   hat(N).transpose() * lever.give * hat(N);
  }
  second = second.plus(1.0, material);
  // Turns do not commute; the second derivative along R exp(turn) is the symmetric part.
  for (Matrix3& block : second.diagonal) block = (0.5 * (block + block.transpose())).eval();
  return result;
}

ChainPlacement ChainEnergy::place(const NodeRotations& R) const {
  ChainPlacement result;
  result.by_wrench.assign(R.size(), Matrix3X6::Zero());
  Vector3& p = result.X_BT.p;
  for (size_t i = 0, body = 0; i < levers_.size(); ++i) {
    const Lever& lever = levers_[i];
    const Matrix3& R_BQ = R[lever.node];
    const Vector3 reach = lever.reach(R);
    p += R_BQ * reach;
    for (; body < body_ends_.size() && body_ends_[body] == i + 1; ++body) result.joints.push_back({R_BQ, p});
    result.give += R_BQ * lever.give * R_BQ.transpose();
    result.by_wrench[lever.node].leftCols<3>() +=
        (hat(reach) - hat(lever.forceIn(R)) * lever.give) * R_BQ.transpose();
  }
  result.X_BT.R = R.back();
  result.by_wrench.back().rightCols<3>() += R.back().transpose();
  return result;
}

}  // namespace live_stiffness
