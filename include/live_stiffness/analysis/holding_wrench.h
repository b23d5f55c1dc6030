#pragma once
// The wrench that holds the tip at a place: a deflection the other way round, on the nonlinear model.

#include <optional>

#include "live_stiffness/analysis/deflection.h"

namespace live_stiffness {

// Where the tip point T is to be held.
struct HoldGoal {
  Vector3 position = Vector3::Zero();  // in B, m
  std::optional<Matrix3> orientation;  // R_BT; none: T turns as it likes, and the wrench is a pure force
};

struct HoldingWrench {
  bool reached = false;             // `held` is at the goal: within 1e-7 of the robot's length, and 1e-7 rad
  Wrench wrench = Wrench::Zero();   // beside the one that acts already; dead, at T, base axes
  StiffnessSolution before;         // without it; unless its status is ok nothing else holds
  StiffnessSolution held;           // under both; where the goal is not reached, of the last good step towards it
  PoseDifference miss;              // of `held` from the goal; rotation 0 where any will do
  int solves = 0;
};

// Newton's method on equilibria of the model: the stiffness, that is the inverse of the tangent compliance (of its
// translational block for a pure force), turns what is left of the way into a change of wrench. It goes straight to the
// goal, in legs of at most a fifth of the robot's length and of a radian, halved where it does not arrive. A dead
// wrench follows the tip wherever that gives way; so the goal is not reached if the robot would buckle, topple or snap
// over on the way there, even where a hand that guides the tip could hold it. pressures: Pa; wrench: acting already, as
// the result. Starts cold. Afterwards workspace holds the equilibrium `held` if its status is ok.
HoldingWrench findHoldingWrench(const StiffnessModel& model, PressuresRef pressures, const Wrench& wrench,
                                const HoldGoal& goal, StiffnessWorkspace& workspace);

}  // namespace live_stiffness
