#pragma once
// Rigid poses SE(3), the exponential of a constant strain, and the transport of compliance between points.

#include "live_stiffness/conventions.h"
#include "live_stiffness/lie/so3.h"

namespace live_stiffness {

// X_AB: rotation R_AB and position p_AB of the origin of B, in axes of A (m).
struct Pose {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();

  Pose operator*(const Pose& X_BC) const;
  Vector3 operator*(const Vector3& p_B) const;
  Pose inverse() const;
};

// Pose after the arc length s (m) along a constant strain: linear v (-), angular u (1/m), in body axes.
// exp(s [v; u]); with v = e3 this is the circular arc (43).
Pose expSe3(const Vector3& v, const Vector3& u, double s, double series_below = kSeriesBelowAngle);

// Twist [v; w] of T (base axes) that takes a predicted pose to the measured one: [p_m - p; log(R_m R^T)], m and rad.
Twist residualTwist(const Pose& measured_X_BT, const Pose& predicted_X_BT);

// Adjoint Ad_AB (47): takes a wrench of frame B to frame A, [f; m]_A = Ad_AB [f; m]_B.
Matrix6 wrenchAdjoint(const Pose& X_AB);

// H of a shift: [v; w] at the point o becomes [v; w] at o + offset, v_p = v_o - offset x w. All in the same axes.
Matrix6 twistShift(const Vector3& offset);

// C about the point o becomes C about the point o + offset, same axes: H C H^T.
Matrix6 shiftCompliance(const Matrix6& C, const Vector3& offset);

// C in base axes becomes C in axes of the body with orientation R_B, same point: (18) without the shift.
Matrix6 complianceInBodyAxes(const Matrix6& C, const Matrix3& R);

}  // namespace live_stiffness
