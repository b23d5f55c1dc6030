#pragma once
// Deflected tip under a wrench: from the compliance matrix (19), and by solving the nonlinear equilibrium anew.

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

struct PredictedDeflection {
  Twist twist = Twist::Zero();  // C w: small twist of T, base axes
  Pose linear;  // T moved by the linear part, turned by the exponential of the angular part: no coupling of the two
  Pose exponential;  // (19): X_BT exp(twist in body axes), a screw motion; equals exp(twist about the base origin) X_BT
};

// X_BT and compliance C of T (base axes), and a wrench at T (base axes). Of any robot.
PredictedDeflection predictDeflection(const Pose& X_BT, const Matrix6& C, const Wrench& wrench);

// How far apart two poses of T are.
struct PoseDifference {
  double position = 0.0;  // m
  double rotation = 0.0;  // rad
};
PoseDifference differenceOf(const Pose& a, const Pose& b);
// Poses of T that two solves of one load found are the same equilibrium, up to what the model's accuracy explains.
bool isSameEquilibrium(const Pose& a, const Pose& b, const StiffnessModel& model);

struct DeflectionCheck {
  SolveStatus status;            // of the equilibrium before, or if that is found of the one under the wrench added
  bool undeflected_ok = false;   // the equilibrium before was found; the next two hold
  Pose undeflected;              // of T before
  PredictedDeflection predicted;
  Pose exact;                    // of T under both wrenches; this and the rest only if status.ok()
  PoseDifference linear_error, exponential_error;  // of the predictions from `exact`
};

// Tip of the model under pressures (Pa) and `wrench`, deflected by `added` (both dead, at T, base axes): predicted from
// the tangent compliance, and solved again. The second solve starts from the first, so that it stays on its branch, as
// the robot does while it is pushed. A wrench under which no equilibrium is found is a status. workspace: of the model;
// not one that live updates go on from.
DeflectionCheck checkDeflection(const StiffnessModel& model, PressuresRef pressures, const Wrench& wrench,
                                const Wrench& added, StiffnessWorkspace& workspace);

}  // namespace live_stiffness
