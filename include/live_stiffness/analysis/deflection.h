#pragma once
// Deflected tip under a wrench: from the compliance matrix (19), and by solving the nonlinear equilibrium again.

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

struct PredictedDeflection {
  Twist twist = Twist::Zero();  // C w: small twist of T, base axes
  Pose linear;  // T moved by the linear part, turned by the exponential of the angular part; the two are not coupled
  Pose exponential;  // (19): X_BT exp(twist in body axes), a screw motion; equals exp(twist about the base origin) X_BT
};

// For any robot: pose X_BT of T in B, compliance C of T (base axes), wrench at T (base axes).
PredictedDeflection predictDeflection(const Pose& X_BT, const Matrix6& C, const Wrench& wrench);

// Distance between two poses of T.
struct PoseDifference {
  double position = 0.0;  // m
  double rotation = 0.0;  // rad
};
PoseDifference differenceOf(const Pose& a, const Pose& b);
// True if two solves of one load, which found T at `a` and at `b`, found the same equilibrium: the poses differ by no more
// than the accuracy of the model explains.
bool isSameEquilibrium(const Pose& a, const Pose& b, const StiffnessModel& model);

struct DeflectionCheck {
  SolveStatus status;            // of the solve without `added`; if that succeeded, of the solve with it
  bool undeflected_ok = false;   // the solve without `added` succeeded; the next two hold
  Pose undeflected;              // of T without `added`
  PredictedDeflection predicted;
  Pose exact;                    // of T under both wrenches; this and the errors only if status.ok()
  PoseDifference linear_error, exponential_error;  // of the predictions from `exact`
};

// Deflection of the tip by the wrench `added`, beside pressures (Pa) and `wrench` (both wrenches dead, at T, base axes):
// predicted from the tangent compliance, and solved again. The second solve starts from the first, so it stays on the same
// branch of equilibria, as the robot does while it is pushed. If no equilibrium is found, the status says so. workspace: made
// by this model; its last solution changes, so do not use the one of live updates.
DeflectionCheck checkDeflection(const StiffnessModel& model, PressuresRef pressures, const Wrench& wrench,
                                const Wrench& added, StiffnessWorkspace& workspace);

}  // namespace live_stiffness
