#include "support/point_loaded_rod.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <stdexcept>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

std::vector<Pose> PointLoadedRod::solve(int steps, int at, const Wrench& wrench) const {
  struct State {
    Pose X;
    Vector3 n, m;
  };
  const Vector3 weight = mass / length * loads.gravity, tip_force = linear(loads.tip) + tip_mass * loads.gravity;
  const auto rate = [&](const State& y) {
    const Vector3 v = Vector3::UnitZ() + rest.c.shear_elongation * (y.X.R.transpose() * y.n);
    const Vector3 u = rest.curvature + rest.c.bending_torsion * (y.X.R.transpose() * y.m);
    State d;
    d.X.p = y.X.R * v;
    d.X.R = y.X.R * hat(u);
    d.n = -weight;
    d.m = -d.X.p.cross(y.n);
    return d;
  };
  std::vector<Pose> poses;
  const double h = length / steps;
  const auto march = [&](const Vector3& base_moment) -> Vector3 {
    State y;
    y.n = tip_force + mass * loads.gravity + linear(wrench);
    y.m = base_moment;
    poses.assign(1, y.X);
    for (int i = 0; i < steps; ++i) {
      if (i == at) {
        y.n -= linear(wrench);
        y.m -= angular(wrench);
      }
      const auto moved = [&](const State& d, double by) {
        return State{{y.X.R + by * d.X.R, y.X.p + by * d.X.p}, y.n + by * d.n, y.m + by * d.m};
      };
      const State a = rate(y), b = rate(moved(a, 0.5 * h)), c = rate(moved(b, 0.5 * h)), d = rate(moved(c, h));
      y = moved(State{{a.X.R + 2.0 * b.X.R + 2.0 * c.X.R + d.X.R, a.X.p + 2.0 * b.X.p + 2.0 * c.X.p + d.X.p},
                      a.n + 2.0 * b.n + 2.0 * c.n + d.n, a.m + 2.0 * b.m + 2.0 * c.m + d.m},
                h / 6.0);
      poses.push_back(y.X);
    }
    return y.m - angular(loads.tip);
  };
  Vector3 base_moment = Vector3::Zero();
  const double scale = tip_force.norm() * length + angular(loads.tip).norm() + 1e-3;  // N m
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Vector3 residual = march(base_moment);
    if (residual.norm() < 1e-14 * scale) return poses;
    Matrix3 jacobian;
    for (int i = 0; i < 3; ++i) {
      const Vector3 step = 1e-5 * scale * Vector3::Unit(i);
      jacobian.col(i) = (march(base_moment + step) - march(base_moment - step)) / (2e-5 * scale);
    }
    const Vector3 change = jacobian.partialPivLu().solve(residual);
    if (change.norm() < 1e-15 * scale) {
      march(base_moment);
      return poses;
    }
    base_moment -= change;
  }
  throw std::runtime_error("PointLoadedRod: shooting did not converge");
}

}  // namespace live_stiffness
