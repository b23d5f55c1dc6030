#include "benchmark/common_practice.h"

#include <Eigen/LU>

namespace live_stiffness {

CommonPractice::CommonPractice(const Scene& scene) : scene_(scene), segment_(std::get<Segment>(scene.chain.at(0))) {}

CommonPractice::State CommonPractice::rate(const RestState& rest, const State& at) const {
  const Matrix3& R = at.X.R;
  const Vector3 v = Vector3::UnitZ() + rest.c.shear_elongation * (R.transpose() * at.n);
  const Vector3 u = rest.curvature + rest.c.bending_torsion * (R.transpose() * at.m);
  State d;
  d.X.p = R * v;
  d.X.R = R * hat(u);
  d.n = -segment_.section.linearDensity() / rest.stretch * *scene_.gravity;
  d.m = -d.X.p.cross(at.n);
  return d;
}

// Residual of the tip wrench, moments over the length.
Vector6 CommonPractice::shoot(const RestState& rest, const Vector6& base_wrench, const Wrench& tip_wrench,
                              Pose& X_BT) const {
  const double length = rest.stretch * segment_.length, h = length / kSteps;
  State s;
  s.n = linear(base_wrench);
  s.m = angular(base_wrench);
  const auto moved = [&s](const State& d, double by) {
    return State{{s.X.R + by * d.X.R, s.X.p + by * d.X.p}, s.n + by * d.n, s.m + by * d.m};
  };
  for (int i = 0; i < kSteps; ++i) {
    const State a = rate(rest, s);
    const State b = rate(rest, moved(a, 0.5 * h));
    const State c = rate(rest, moved(b, 0.5 * h));
    const State d = rate(rest, moved(c, h));
    s = moved({{a.X.R + 2.0 * b.X.R + 2.0 * c.X.R + d.X.R, a.X.p + 2.0 * b.X.p + 2.0 * c.X.p + d.X.p},
               a.n + 2.0 * b.n + 2.0 * c.n + d.n,
               a.m + 2.0 * b.m + 2.0 * c.m + d.m},
              h / 6.0);
  }
  X_BT = s.X;
  Vector6 residual;
  linear(residual) = s.n - linear(tip_wrench) - scene_.tip_mass * *scene_.gravity;
  angular(residual) = (s.m - angular(tip_wrench)) / length;
  return residual;
}

bool CommonPractice::newton(const RestState& rest, const Wrench& tip_wrench, Vector6& base_wrench, Pose& X_BT) const {
  constexpr double kStep = 1e-6, kTolerance = 1e-10;  // N
  Vector6 residual = shoot(rest, base_wrench, tip_wrench, X_BT);
  for (int iteration = 0; iteration < 20; ++iteration) {
    if (residual.norm() < kTolerance) return true;
    Matrix6 jacobian;
    Pose unused;
    for (int i = 0; i < 6; ++i) {
      const double step = i < 3 ? kStep : kStep * segment_.length;
      jacobian.col(i) = (shoot(rest, base_wrench + step * Vector6::Unit(i), tip_wrench, unused) - residual) / step;
    }
    base_wrench -= jacobian.partialPivLu().solve(residual);
    residual = shoot(rest, base_wrench, tip_wrench, X_BT);
  }
  return false;
}

CommonPractice::Solution CommonPractice::solve(const RestState& rest) {
  Solution solution;
  solution.converged = newton(rest, Wrench::Zero(), base_wrench_, solution.X_BT);
  for (int i = 0; i < 6 && solution.converged; ++i) {
    const double step = i < 3 ? 1e-5 : 1e-5 * segment_.length;  // N, N m: best between truncation and rounding
    Vector6 base_wrench = base_wrench_;
    Pose X;
    solution.converged = newton(rest, step * Wrench::Unit(i), base_wrench, X);
    solution.compliance.col(i).head<3>() = (X.p - solution.X_BT.p) / step;
    solution.compliance.col(i).tail<3>() = logSo3(X.R * solution.X_BT.R.transpose()) / step;
  }
  return solution;
}

}  // namespace live_stiffness
