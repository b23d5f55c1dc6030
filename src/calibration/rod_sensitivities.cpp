#include "calibration/rod_sensitivities.h"

namespace live_stiffness {
namespace rod_sensitivities {
namespace {

constexpr int kSteps = 5;

void add(Section& at, const Section& d, double h) {
  at.R += h * d.R;
  at.p += h * d.p;
  at.m += h * d.m;
  at.turn += h * d.turn;
  at.dp += h * d.dp;
  at.dm += h * d.dm;
}

}  // namespace

Section rate(const Section& at, const SegmentColumns& s, const Beyond& beyond) {
  const Matrix3& R = at.R;
  const Vector3 n_body = R.transpose() * beyond.n, m_body = R.transpose() * at.m;
  const Vector3 v = Vector3::UnitZ() + s.c_se.cwiseProduct(n_body);
  const Vector3 u = s.curvature + s.c_bt * m_body;
  Section d;
  d.R = R * hat(s.length * u);
  d.p = s.length * (R * v);
  d.m = beyond.n.cross(d.p);

  // R^T (delta n - turn x n) and the same of m
  const SeedColumns dn_body = R.transpose() * (beyond.dn + hat(beyond.n) * at.turn);
  const SeedColumns dm_body = R.transpose() * (at.dm + hat(at.m) * at.turn);
  SeedColumns dv = s.c_se.asDiagonal() * dn_body;
  dv += n_body.asDiagonal() * s.d_c_se;
  SeedColumns du = s.d_curvature;
  du.noalias() += s.c_bt * dm_body;
  du.row(0) += m_body.x() * s.d_xx + m_body.y() * s.d_xy;
  du.row(1) += m_body.x() * s.d_xy + m_body.y() * s.d_yy;
  du.row(2) += m_body.z() * s.d_zz;
  dv *= s.length;
  du *= s.length;
  dv.noalias() += v * s.d_length;
  du.noalias() += u * s.d_length;

  d.turn.noalias() = R * du;
  d.dp.noalias() = R * dv;
  d.dp.noalias() -= hat(d.p) * at.turn;
  d.dm.noalias() = hat(beyond.n) * d.dp;
  d.dm.noalias() -= hat(d.p) * beyond.dn;
  return d;
}

void integrateSegment(const SegmentColumns& segment, const Vector3& gravity, const Vector3& tip_force, double& mass_beyond,
                  SeedRow& d_mass_beyond, Section& at) {
  const auto beyond = [&](double x) -> Beyond {
    return {tip_force + gravity * (mass_beyond - x * segment.mass), gravity * (d_mass_beyond - x * segment.d_mass)};
  };
  constexpr double h = 1.0 / kSteps;
  Beyond start = beyond(0.0);
  for (int k = 0; k < kSteps; ++k) {
    const Beyond middle = beyond((k + 0.5) * h), end = beyond((k + 1) * h);
    Section moved = at;
    const Section k1 = rate(at, segment, start);
    add(moved, k1, 0.5 * h);
    const Section k2 = rate(moved, segment, middle);
    moved = at;
    add(moved, k2, 0.5 * h);
    const Section k3 = rate(moved, segment, middle);
    moved = at;
    add(moved, k3, h);
    const Section k4 = rate(moved, segment, end);
    add(at, k1, h / 6.0);
    add(at, k2, h / 3.0);
    add(at, k3, h / 3.0);
    add(at, k4, h / 6.0);
    start = end;
  }
  mass_beyond -= segment.mass;
  d_mass_beyond -= segment.d_mass;
}

// The link's mass acts at its middle, so it loads the near half only. The length of a link is no parameter.
void passLink(double length, const Vector3& gravity, const Vector3& tip_force, double mass, const SeedRow& d_mass,
              double& mass_beyond, SeedRow& d_mass_beyond, Section& at) {
  const Vector3 half = 0.5 * length * at.R.col(2);
  const SeedColumns d_half = -hat(half) * at.turn;
  for (int part = 0; part < 2; ++part) {
    const Vector3 n = tip_force + mass_beyond * gravity;
    at.m -= half.cross(n);
    at.dm += hat(n) * d_half - hat(half) * (gravity * d_mass_beyond);
    at.p += half;
    at.dp += d_half;
    if (part == 0) {
      mass_beyond -= mass;
      d_mass_beyond -= d_mass;
    }
  }
}

TipSensitivities finish(const Section& at, const Vector3& tip_offset, const Beyond& beyond) {
  const Vector3 arm = at.R * tip_offset;
  const SeedColumns d_arm = -hat(arm) * at.turn;
  return {at.dp + d_arm, at.turn, at.dm + hat(beyond.n) * d_arm - hat(arm) * beyond.dn};
}

}  // namespace rod_sensitivities
}  // namespace live_stiffness
