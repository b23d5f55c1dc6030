#pragma once
// The classical Runge-Kutta method on the rod's equations, the rotation matrix as nine numbers: common practice.

#include "benchmark/methods/loaded_chain.h"

namespace live_stiffness {

// v and u of a section, body axes.
struct Strain {
  Vector3 v, u;
};

inline Strain strainOf(const SoftPiece& piece, const RodState& at) {
  return {Vector3::UnitZ() + piece.rest.c.shear_elongation * (at.X.R.transpose() * at.n),
          piece.rest.curvature + piece.rest.c.bending_torsion * (at.X.R.transpose() * at.m)};
}

// d/ds of a state: p' = R v, R' = R hat(u), n' = -w, m' = -p' x n.
inline void rodRate(const SoftPiece& piece, const RodState& at, RodState& rate) {
  const Strain strain = strainOf(piece, at);
  const Vector3& u = strain.u;
  rate.X.p.noalias() = at.X.R * strain.v;
  rate.X.R.col(0) = u.z() * at.X.R.col(1) - u.y() * at.X.R.col(2);
  rate.X.R.col(1) = u.x() * at.X.R.col(2) - u.z() * at.X.R.col(0);
  rate.X.R.col(2) = u.y() * at.X.R.col(0) - u.x() * at.X.R.col(1);
  rate.n = -piece.line_load;
  rate.m = at.n.cross(rate.X.p);
}

inline void addScaled(const RodState& state, double factor, const RodState& rate, RodState& sum) {
  sum.X.R = state.X.R + factor * rate.X.R;
  sum.X.p = state.X.p + factor * rate.X.p;
  sum.n = state.n + factor * rate.n;
  sum.m = state.m + factor * rate.m;
}

// The four stages of a step: states at which the rates are taken, and the rates.
struct Rk4Stages {
  RodState at[4], rate[4];
};

// One step of length h. The stages are there for those who carry more than the state.
inline void rk4Step(const SoftPiece& piece, double h, RodState& state, Rk4Stages& stages) {
  constexpr double kReach[] = {0.0, 0.5, 0.5, 1.0};
  stages.at[0] = state;
  rodRate(piece, state, stages.rate[0]);
  for (int i = 1; i < 4; ++i) {
    addScaled(state, kReach[i] * h, stages.rate[i - 1], stages.at[i]);
    rodRate(piece, stages.at[i], stages.rate[i]);
  }
  const auto& [a, b, c, d] = stages.rate;
  state.X.R += h / 6.0 * (a.X.R + 2.0 * (b.X.R + c.X.R) + d.X.R);
  state.X.p += h / 6.0 * (a.X.p + 2.0 * (b.X.p + c.X.p) + d.X.p);
  state.n += h * a.n;
  state.m += h / 6.0 * (a.m + 2.0 * (b.m + c.m) + d.m);
}

}  // namespace live_stiffness
