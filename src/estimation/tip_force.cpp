#include "estimation/tip_force.h"

#include <Eigen/LU>

namespace live_stiffness {

Twist residualTwist(const Pose& measured_X_BT, const Pose& predicted_X_BT) {
  Twist residual;
  residual << measured_X_BT.p - predicted_X_BT.p, logSo3(measured_X_BT.R * predicted_X_BT.R.transpose());
  return residual;
}

TipForce estimateTipForce(const Matrix6& C, const Twist& residual, const TrackerNoise& noise) {
  Vector6 inverse_deviation;
  inverse_deviation << Vector3::Constant(1.0 / noise.position), Vector3::Constant(1.0 / noise.rotation);
  const Eigen::Matrix<double, 6, 3> design = inverse_deviation.asDiagonal() * C.leftCols<3>();
  TipForce estimate;
  estimate.covariance = (design.transpose() * design).inverse();
  estimate.force = estimate.covariance * design.transpose() * inverse_deviation.cwiseProduct(residual);
  return estimate;
}

}  // namespace live_stiffness
