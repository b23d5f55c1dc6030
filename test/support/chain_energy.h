#pragma once
// Potential energy of a robot under dead loads as a function of the rotations of many sections, its nodes.
//
// Pressure is a rest strain (docs/derivation.md, section 1) and the force n(s) is known, so the strain v of least energy is
// known, too, and only rotations are left:
//   E = int (u - u_rest) . c_bt^-1 (u - u_rest) / 2 - N . (e3 + c_se N / 2) ds,  N = R^T n,
// less the work of the loads on links and on the tip's offset. Between two nodes the curvature is constant,
// log(R_i^T R_i+1) / h; the work is summed by the trapezoidal rule. Errors are series in even powers of h.

#include <vector>

#include "live_stiffness/lie/se3.h"
#include "live_stiffness/rod/scene.h"
#include "section/load_stepping.h"
#include "support/block_tridiagonal.h"

namespace live_stiffness {

using NodeRotations = NodeBlocks<3>;  // R_BQ, base to tip; the first is the base plate's

// R_i exp(factor turn_i); turns in axes of the sections, rad. The base does not turn.
NodeRotations turned(NodeRotations R, double factor, const NodeVectors& turns);

// By small turns of the nodes in their own axes.
struct EnergyDerivatives {
  NodeVectors gradient;               // E', N m; of the base, too: what the base plate exerts on the robot
  BlockTridiagonal second, material;  // E'', and its part that is positive anyway, as of the weightless robot; N m/rad
};

// What follows from the rotations; base axes.
struct ChainPlacement {
  Pose X_BT;                 // tip point, m
  std::vector<Pose> joints;  // far end of each body, base to tip, m
  Matrix3 give = Matrix3::Zero();    // motion of T by a tip force while nothing turns, m/N
  NodeBlocks<6> by_wrench;           // -dE'/dw by the tip wrench w, which is also the transposed twist of T by a turn
};

class ChainEnergy {
 public:
  // tip_force: N, at T, base axes; n: intervals a segment.
  ChainEnergy(const Scene& scene, const std::vector<RestState>& rest, const Vector3& tip_force, int n);

  // The robot without external loads.
  NodeRotations unloaded() const;
  // E, J. uncertainty: if given, what rounding may have changed, J.
  double value(const NodeRotations& R, double* uncertainty = nullptr) const;
  EnergyDerivatives derivatives(const NodeRotations& R) const;
  ChainPlacement place(const NodeRotations& R) const;

 private:
  // Between two nodes.
  struct Interval {
    Matrix3 stiffness;  // c_bt^-1 / h, N m/rad
    Vector3 rest;       // h u_rest, rad
  };
  // Part of the way from base to tip, which turns with a node: R (arm + give R^T force).
  struct Lever {
    size_t node;
    Vector3 force;  // that it carries, N, base axes
    Vector3 arm;    // m, section axes
    Matrix3 give;   // m/N, section axes

    Vector3 forceIn(const NodeRotations& R) const { return R[node].transpose() * force; }
    Vector3 reach(const NodeRotations& R) const { return arm + give * forceIn(R); }
  };

  std::vector<Interval> intervals_;  // base to tip
  std::vector<Lever> levers_;
  std::vector<size_t> body_ends_;  // number of levers up to the end of each body
};

}  // namespace live_stiffness
