#include "live_stiffness/analysis/deflection.h"

#include <algorithm>

namespace live_stiffness {

PredictedDeflection predictDeflection(const Pose& X_BT, const Matrix6& C, const Wrench& wrench) {
  PredictedDeflection predicted;
  predicted.twist = C * wrench;
  const Vector3 v = linear(predicted.twist), w = angular(predicted.twist);
  predicted.linear = {expSo3(w) * X_BT.R, X_BT.p + v};
  predicted.exponential = X_BT * expSe3(X_BT.R.transpose() * v, X_BT.R.transpose() * w, 1.0);
  return predicted;
}

PoseDifference differenceOf(const Pose& a, const Pose& b) {
  return {(a.p - b.p).norm(), logSo3(a.R * b.R.transpose()).norm()};
}

bool isSameEquilibrium(const Pose& a, const Pose& b, const StiffnessModel& model) {
  constexpr double kMargin = 1e3;  // on a soft robot a small error of the loads is a larger error of the pose
  const double tolerance = std::clamp(kMargin * model.options().accuracy, 1e-6, 0.1);
  const PoseDifference difference = differenceOf(a, b);
  return difference.position <= tolerance * model.scene().length() && difference.rotation <= tolerance;
}

DeflectionCheck checkDeflection(const StiffnessModel& model, PressuresRef pressures, const Wrench& wrench,
                                const Wrench& added, StiffnessWorkspace& workspace) {
  DeflectionCheck check;
  workspace.reset();
  const StiffnessSolution before = model.solve(pressures, wrench, workspace);
  check.status = before.status;
  if (!before.status.ok()) return check;
  check.undeflected_ok = true;
  check.undeflected = before.X_BT;
  check.predicted = predictDeflection(before.X_BT, before.compliance, added);
  const StiffnessSolution after = model.solve(pressures, wrench + added, workspace);
  check.status = after.status;
  if (!after.status.ok()) return check;
  check.exact = after.X_BT;
  check.linear_error = differenceOf(check.predicted.linear, check.exact);
  check.exponential_error = differenceOf(check.predicted.exponential, check.exact);
  return check;
}

}  // namespace live_stiffness
