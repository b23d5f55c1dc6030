#pragma once
// One stretch of a Cosserat rod between two arc lengths, sampled at the Gauss-Legendre nodes.
//
// In body axes the actuation wrench of a fluidic segment is constant along it, so it is a rest strain and not a load:
//   v = e3 + c_se R^T n,   u = u_rest + c_bt R^T m                                             (7), (9), (37)
//   p' = R v,  R' = R hat(u),  n' = -w - R f,  m' = -p' x n                                    (8)
// with n, m the *external* loads only, w a dead line load (weight) and f one that follows the section.

#include <array>

#include "live_stiffness/gauss_legendre.h"
#include "live_stiffness/lie/se3.h"
#include "live_stiffness/section/load_stepping.h"

namespace live_stiffness {

using StageVectors = Eigen::Matrix<double, 3, kStages>;  // one column per Gauss node

struct RodElement {
  // Set by the caller. Wrenches in base axes; arc lengths are stretched ones, m.
  int segment = 0;       // index of the segment it is part of
  double start = 0.0;    // from the segment's base
  double length = 0.0;   // negative: integrated from tip towards base
  Pose X_start;          // pose of its first section in B
  Vector3 n_start = Vector3::Zero();         // N
  Vector3 m_start = Vector3::Zero();         // N m
  Vector3 line_load = Vector3::Zero();       // w, N/m
  Vector3 follower_load = Vector3::Zero();   // f, N/m, body axes

  // The solution.
  Pose X_end;
  Vector3 n_end = Vector3::Zero();
  Vector3 m_end = Vector3::Zero();
  std::array<Pose, kStages> X;               // at the nodes
  StageVectors n = StageVectors::Zero();     // at the nodes
  StageVectors m = StageVectors::Zero();
  StageVectors rotation = StageVectors::Zero();  // rotation vectors from X_start, rad; also the next solve's guess
  StageVectors tangent = StageVectors::Zero();   // p', -
  double truncation = 0.0;  // size of the highest Legendre coefficient of the curvature, or what the one below it lets
                            // expect if larger, times length, rad

  double weight(int i) const { return length * gaussLegendre().b[i]; }  // quadrature weight of node i, m
};

// Fills the element when nothing external acts: a constant strain, X(s) = X_start exp(s [e3; u_rest]). Exact.
void placeUnloaded(const RestState& rest, RodElement& element);

// Integrates the element from its start values by Lie collocation of order 2 kStages: rotation vectors at the nodes,
// fixed-point passes from the values already there (call resetGuess first when there are none). Returns false if the
// passes do not converge: the element is too long for its load or curvature.
bool integrate(const RestState& rest, RodElement& element);

// Starts the passes of integrate() from the unloaded shape under a constant moment.
void resetGuess(const RestState& rest, RodElement& element);

// Derivatives of a section's state with respect to six parameters (columns): rotation phi (rad, base axes, R changes
// by hat(phi) R), position p and moment m; n changes by `n`, the same all along the rod.
struct StateColumns {
  Matrix3X6 phi = Matrix3X6::Zero();
  Matrix3X6 p = Matrix3X6::Zero();
  Matrix3X6 m = Matrix3X6::Zero();
  Matrix3X6 n = Matrix3X6::Zero();
};

// Carries columns from the start to the end of an integrated element by collocation of the linearised rod
//   phi' = R c_bt R^T (dm - phi x m),  dp' = phi x p' + R c_se R^T (dn - phi x n),  dm' = -dp' x n - p' x dn.
// Dead loads only.
void propagate(const RestState& rest, const RodElement& element, StateColumns& columns);

}  // namespace live_stiffness
