#pragma once
// The wrench that holds the tip at a given place: the inverse of a deflection, on the nonlinear model.

#include <optional>

#include "live_stiffness/analysis/deflection.h"

namespace live_stiffness {

// Where the tip point T is to be held.
struct HoldGoal {
  Vector3 position = Vector3::Zero();  // in B, m
  std::optional<Matrix3> orientation;  // R_BT; none: T may turn freely, and the wrench is a pure force
};

struct HoldingWrench {
  bool reached = false;             // `held` is at the goal: within 1e-7 of the robot's length, and 1e-7 rad
  Wrench wrench = Wrench::Zero();   // beside the one that acts already; dead, at T, base axes
  StiffnessSolution before;         // without it; unless its status is ok nothing else holds
  StiffnessSolution held;           // under both; if the goal is not reached: the last good step towards it
  PoseDifference miss;              // of `held` from the goal; rotation 0 if the goal has no orientation
  int solves = 0;
};

// Newton's method on equilibria of the model: the remaining distance times the stiffness, that is the inverse of the tangent
// compliance (of its translational block for a pure force), is the change of wrench. The tip goes straight to the goal in
// steps of at most a fifth of the robot's length and a fifth of a radian, which are halved where Newton's method does not
// converge. Every equilibrium on the way must be stable under a dead wrench. So the goal is not reached if the robot would
// buckle, topple or snap through on the way there, even if a hand that guides the tip could hold it. pressures: Pa; wrench:
// acts already; dead, at T, base axes. Starts cold. Afterwards workspace holds the equilibrium `held` if its status is ok.
HoldingWrench findHoldingWrench(const StiffnessModel& model, PressuresRef pressures, const Wrench& wrench,
                                const HoldGoal& goal, StiffnessWorkspace& workspace);

}  // namespace live_stiffness
