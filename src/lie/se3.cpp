#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

Pose Pose::operator*(const Pose& X_BC) const { return {R * X_BC.R, p + R * X_BC.p}; }

Vector3 Pose::operator*(const Vector3& p_B) const { return p + R * p_B; }

Pose Pose::inverse() const { return {R.transpose(), -(R.transpose() * p)}; }

Pose expSe3(const Vector3& v, const Vector3& u, double s, double series_below) {
  const Vector3 w = s * u;
  const double x = w.squaredNorm();
  const Vector3 w_cross_v = w.cross(v);
  return {expSo3(w, series_below),
          s * (v + angleB(x, series_below) * w_cross_v + angleC(x, series_below) * w.cross(w_cross_v))};
}

Twist residualTwist(const Pose& measured_X_BT, const Pose& predicted_X_BT) {
  Twist residual;
  residual << measured_X_BT.p - predicted_X_BT.p, logSo3(measured_X_BT.R * predicted_X_BT.R.transpose());
  return residual;
}

Matrix6 wrenchAdjoint(const Pose& X_AB) {
  Matrix6 adjoint;
  adjoint << X_AB.R, Matrix3::Zero(), hat(X_AB.p) * X_AB.R, X_AB.R;
  return adjoint;
}

Matrix6 twistShift(const Vector3& offset) {
  Matrix6 shift = Matrix6::Identity();
  shift.topRightCorner<3, 3>() = -hat(offset);
  return shift;
}

Matrix6 shiftCompliance(const Matrix6& C, const Vector3& offset) {
  const Matrix6 H = twistShift(offset);
  return H * C * H.transpose();
}

Matrix6 complianceInBodyAxes(const Matrix6& C, const Matrix3& R) {
  Matrix6 turn = Matrix6::Zero();
  turn.topLeftCorner<3, 3>() = R;
  turn.bottomRightCorner<3, 3>() = R;
  return turn.transpose() * C * turn;
}

}  // namespace live_stiffness
