#include "support/literal_rod.h"

#include <Eigen/LU>
#include <stdexcept>

namespace live_stiffness {

LiteralRod::LiteralRod(const Segment& segment, double tip_mass, const DeadLoads& loads, const Pressures& pressures,
                       const RestState& rest)
    : rest_(rest),
      loads_(loads),
      length_(rest.stretch * segment.length),
      tip_mass_(tip_mass),
      weight_(segment.mass() / length_ * loads.gravity),
      F_P_(Vector3::Zero()) {
  const Chambers& chambers = segment.section.chambers;
  Vector3 T_P = Vector3::Zero();
  for (int k = 0; k < chambers.count(); ++k) {
    chamber_force_.push_back(pressures[k] * chambers.area() * Vector3::UnitZ());
    d_.push_back(chambers.centre(k, rest.stretch));
    F_P_ += chamber_force_[k];
    T_P += d_[k].cross(chamber_force_[k]);
  }
  v_star_ = Vector3::UnitZ() - rest.c.shear_elongation * F_P_;
  u_star_ = rest.curvature - rest.c.bending_torsion * T_P;
}

LiteralRod::State LiteralRod::rate(const State& at) const {
  const Matrix3& R = at.X.R;
  const Vector3 v = v_star_ + rest_.c.shear_elongation * (R.transpose() * at.n);  // (37)
  const Vector3 u = u_star_ + rest_.c.bending_torsion * (R.transpose() * at.m);
  State d;
  d.X.p = R * v;
  d.X.R = R * hat(u);
  Vector3 f_P = Vector3::Zero(), l_P = Vector3::Zero();
  for (size_t k = 0; k < d_.size(); ++k) {
    f_P += d.X.R * chamber_force_[k];                                                               // (32)
    l_P += R * ((v + u.cross(d_[k])).cross(chamber_force_[k]) + d_[k].cross(u.cross(chamber_force_[k])));  // (34)
  }
  d.n = -weight_ + f_P;
  d.m = -d.X.p.cross(at.n) + l_P;
  return d;
}

LiteralRod::State LiteralRod::march(const Vector6& base_wrench, int steps, std::vector<Pose>* poses) const {
  State s;
  if (poses) poses->assign(1, s.X);
  s.n = linear(base_wrench);
  s.m = angular(base_wrench);
  const double h = length_ / steps;
  const auto moved = [&](const State& d, double by) {
    return State{{s.X.R + by * d.X.R, s.X.p + by * d.X.p}, s.n + by * d.n, s.m + by * d.m};
  };
  for (int i = 0; i < steps; ++i) {
    const State a = rate(s), b = rate(moved(a, 0.5 * h)), c = rate(moved(b, 0.5 * h)), d = rate(moved(c, h));
    s = moved(State{{a.X.R + 2.0 * b.X.R + 2.0 * c.X.R + d.X.R, a.X.p + 2.0 * b.X.p + 2.0 * c.X.p + d.X.p},
                    a.n + 2.0 * b.n + 2.0 * c.n + d.n, a.m + 2.0 * b.m + 2.0 * c.m + d.m},
              h / 6.0);
    if (poses) poses->push_back(s.X);
  }
  return s;
}

Vector6 LiteralRod::residual(const State& tip) const {  // (35), moments over the length
  Vector3 n = linear(loads_.tip) + tip_mass_ * loads_.gravity;
  Vector3 m = angular(loads_.tip);
  for (size_t k = 0; k < d_.size(); ++k) {
    n += tip.X.R * chamber_force_[k];
    m += tip.X.R * d_[k].cross(chamber_force_[k]);
  }
  Vector6 result;
  linear(result) = tip.n - n;
  angular(result) = (tip.m - m) / length_;
  return result;
}

std::vector<Pose> LiteralRod::solveAlong(int steps) const {
  std::vector<Pose> poses;
  const double scale = F_P_.norm() + linear(loads_.tip).norm() + 1.0;  // N
  Vector6 base = Vector6::Zero();  // start: the wrench of pressure alone, on a rod that has it all along
  linear(base) = F_P_;
  for (size_t k = 0; k < d_.size(); ++k) angular(base) += d_[k].cross(chamber_force_[k]);
  for (int iteration = 0; iteration < 40; ++iteration) {
    const State tip = march(base, steps, &poses);
    const Vector6 r = residual(tip);
    if (r.norm() < 1e-12 * scale) return poses;
    Matrix6 jacobian;
    for (int i = 0; i < 6; ++i) {
      const double step = 1e-6 * scale * (i < 3 ? 1.0 : length_);
      jacobian.col(i) = (residual(march(base + step * Vector6::Unit(i), steps)) -
                         residual(march(base - step * Vector6::Unit(i), steps))) / (2.0 * step);
    }
    base -= jacobian.partialPivLu().solve(r);
  }
  throw std::runtime_error("LiteralRod: shooting did not converge");
}

}  // namespace live_stiffness
