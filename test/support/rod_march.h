#pragma once
// A rod of constant section from its base to its end as an initial value problem, by RK4 on rotation matrices: shares
// nothing with the library's elements.

#include "live_stiffness/lie/se3.h"
#include "live_stiffness/section/cross_section.h"
#include "section/section_moments.h"

namespace live_stiffness {

struct RodEnd {
  Pose X;          // in B
  Wrench wrench;   // of what is beyond on the rod, about its end, base axes
};

// base_wrench: of the rod beyond on the base, about the rod's base X_BD, base axes. Length in m, gravity in m/s^2.
inline RodEnd marchRod(const CrossSection& section, const Pose& X_BD, double length, const Wrench& base_wrench,
                       const Vector3& gravity, int steps) {
  const ComplianceDensity c = SectionMoments(section).complianceDensity(1.0);
  struct State {
    Matrix3 R;
    Vector3 p, n, m;
  };
  const auto rate = [&](const State& at) {  // (8), (9)
    const Vector3 v = Vector3::UnitZ() + c.shear_elongation * (at.R.transpose() * at.n);
    const Vector3 u = c.bending_torsion * (at.R.transpose() * at.m);
    return State{at.R * hat(u), at.R * v, -section.linearDensity() * gravity, -(at.R * v).cross(at.n)};
  };
  State s{X_BD.R, X_BD.p, linear(base_wrench), angular(base_wrench)};
  const auto moved = [&](const State& d, double by) {
    return State{s.R + by * d.R, s.p + by * d.p, s.n + by * d.n, s.m + by * d.m};
  };
  const double h = length / steps;
  for (int i = 0; i < steps; ++i) {
    const State a = rate(s), b = rate(moved(a, 0.5 * h)), d = rate(moved(b, 0.5 * h)), e = rate(moved(d, h));
    s = moved({a.R + 2.0 * b.R + 2.0 * d.R + e.R, a.p + 2.0 * b.p + 2.0 * d.p + e.p,
               a.n + 2.0 * b.n + 2.0 * d.n + e.n, a.m + 2.0 * b.m + 2.0 * d.m + e.m}, h / 6.0);
  }
  return {{s.R, s.p}, (Wrench() << s.n, s.m).finished()};
}

}  // namespace live_stiffness
