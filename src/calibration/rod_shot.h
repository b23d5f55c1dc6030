#pragma once
// The rod as an initial value problem from its base moment, in numbers that carry derivatives. Only derivatives are
// taken from it: the equilibrium itself is the solver's.

#include <cmath>

#include "calibration/parametric_scene.h"
#include "live_stiffness/section/load_stepping.h"

namespace live_stiffness {

template <class T>
struct RodShot {
  Matrix3Of<T> R;         // of the tip in B
  Vector3Of<T> p;         // of T in B, m
  Vector3Of<T> residual;  // moment left over at T, N m, base axes
};

namespace rod_shot {

template <class T>
struct Section {
  Matrix3Of<T> R;
  Vector3Of<T> p, m;
};

// d/dx of a section, x the fraction of the segment's length: p' = R v, R' = R hat(u), m' = -p' x n (32)-(36) with the
// pressures in the rest strains.
template <class T>
Section<T> rate(const Section<T>& at, const RestStateOf<T>& rest, const T& length, const Vector3Of<T>& n) {
  const Vector3Of<T> n_body = at.R.transpose() * n;
  const Vector3Of<T> m_body = at.R.transpose() * at.m;
  Vector3Of<T> v = rest.c.shear_elongation.diagonal().cwiseProduct(n_body);
  v.z() += 1.0;
  Vector3Of<T> u = rest.curvature;
  u.template head<2>() += rest.c.bending_torsion.template topLeftCorner<2, 2>() * m_body.template head<2>();
  u.z() += rest.c.bending_torsion(2, 2) * m_body.z();
  u *= length;
  Section<T> d;
  d.p = at.R * v * length;
  d.m = n.cross(d.p);
  d.R.col(0) = at.R.col(1) * u.z() - at.R.col(2) * u.y();
  d.R.col(1) = at.R.col(2) * u.x() - at.R.col(0) * u.z();
  d.R.col(2) = at.R.col(0) * u.y() - at.R.col(1) * u.x();
  return d;
}

template <class T>
Section<T> moved(const Section<T>& at, const Section<T>& d, double h) {
  return {at.R + d.R * T(h), at.p + d.p * T(h), at.m + d.m * T(h)};
}

}  // namespace rod_shot

// Runge-Kutta of fourth order. rest: one per segment. tip: dead wrench at T, base axes. kSteps a segment leave an error
// of 1e-6 of its length in the shape, and the same relative one in derivatives: enough for a least-squares step.
template <class T>
RodShot<T> shootRod(const ParametricScene<T>& scene, const std::vector<RestStateOf<T>>& rest,
                    const Vector3Of<T>& base_moment, const Wrench& tip) {
  constexpr int kSteps = 10;
  using rod_shot::Section;
  const Vector3Of<T> gravity = scene.gravity.template cast<T>();
  T mass_beyond = scene.tip_mass;
  for (const ParametricBody<T>& body : scene.chain)
    mass_beyond += body.is_segment ? T(body.section.linearDensity() * body.length) : body.mass;
  const Vector3Of<T> tip_force = tip.head<3>().cast<T>();
  Section<T> at;
  at.R = Matrix3::Identity().cast<T>();
  at.p = Vector3::Zero().cast<T>();
  at.m = base_moment;
  size_t next = 0;
  for (const ParametricBody<T>& body : scene.chain) {
    if (body.is_segment) {
      const RestStateOf<T>& state = rest[next++];
      const T length = state.stretch * body.length;
      const T mass = body.section.linearDensity() * body.length;
      const auto force = [&](double x) -> Vector3Of<T> { return tip_force + gravity * T(mass_beyond - mass * x); };
      constexpr double h = 1.0 / kSteps;
      for (int k = 0; k < kSteps; ++k) {
        const Vector3Of<T> n1 = force(k * h), n2 = force((k + 0.5) * h), n3 = force((k + 1) * h);
        const Section<T> k1 = rate(at, state, length, n1);
        const Section<T> k2 = rate(moved(at, k1, 0.5 * h), state, length, n2);
        const Section<T> k3 = rate(moved(at, k2, 0.5 * h), state, length, n2);
        const Section<T> k4 = rate(moved(at, k3, h), state, length, n3);
        at = moved(moved(moved(moved(at, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
      }
      mass_beyond -= mass;
    } else {
      const Vector3Of<T> half = at.R.col(2) * T(0.5 * body.length);
      const Vector3Of<T> before = tip_force + gravity * mass_beyond;
      mass_beyond -= body.mass;
      const Vector3Of<T> after = tip_force + gravity * mass_beyond;
      at.m -= half.cross(before) + half.cross(after);
      at.p += half + half;
    }
  }
  const Vector3Of<T> to_tip = at.R * scene.tip_offset.template cast<T>();
  const Vector3Of<T> n_tip = tip_force + gravity * scene.tip_mass;
  return {at.R, at.p + to_tip, at.m - to_tip.cross(n_tip) - tip.tail<3>().cast<T>()};
}

}  // namespace live_stiffness
