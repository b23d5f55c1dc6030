#pragma once
// The paper's boundary value problem (36) with (35), integrated as printed: the oracle for the library's rest-strain
// formulation. Internal wrench n, m *including* pressure, rotation matrices, RK4 with many steps, Newton shooting on
// the base wrench with a finite-difference Jacobian. One segment, T at its end.
//
// Deviations from the print, each needed to make it a balance of moments or to count every load once:
//  - m' has -p_s x n as in (8) and (34); (36) prints -p_hat n;
//  - m(l) has R d_k x (P_k A_P e3), as T_P in section 3.3; (35) prints d_k A_P P_k e3;
//  - arc length runs over the stretched length lam l0, so pressure's own stretch is taken out of v by
//    v* = e3 - c_se F_P; and u* = u_rest - c_bt(lam) T_P(lam) carries what earlier load steps left.

#include "rod/backbone.h"

namespace live_stiffness {

class LiteralRod {
 public:
  LiteralRod(const Segment& segment, double tip_mass, const DeadLoads& loads, const Pressures& pressures,
             const RestState& rest);

  // Pose of the tip. Throws std::runtime_error unless the tip wrench is met to 1e-12 of its scale.
  Pose solve(int steps) const { return solveAlong(steps).back(); }

  // The same after every step, base first: steps + 1 poses. Their rotation matrices are as RK4 leaves them.
  std::vector<Pose> solveAlong(int steps) const;

 private:
  struct State {
    Pose X;
    Vector3 n, m;
  };
  State rate(const State& at) const;
  // The state at the tip; poses, if given, gets those of all steps.
  State march(const Vector6& base_wrench, int steps, std::vector<Pose>* poses = nullptr) const;
  Vector6 residual(const State& tip) const;

  const RestState& rest_;
  DeadLoads loads_;
  double length_, tip_mass_;
  Vector3 weight_;  // f_g per stretched length, N/m
  Vector3 F_P_;
  std::vector<Vector3> chamber_force_, d_;  // P_k A_P e3 and d_k, section axes
  Vector3 v_star_, u_star_;
};

}  // namespace live_stiffness
