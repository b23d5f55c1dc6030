#pragma once
// External tip force from what the tracker sees: residual twist = C W.

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

// Noise of a tracker, standard deviations: position per axis, m; rotation per axis, rad. Default: an NDI Aurora's
// 0.48 mm and 0.30 deg, taken as the length of the error.
struct TrackerNoise {
  double position = 0.48e-3 / 1.7320508075688772;
  double rotation = radians(0.30) / 1.7320508075688772;
};

struct TipForce {
  Vector3 force = Vector3::Zero();       // N, base axes
  Matrix3 covariance = Matrix3::Zero();  // N^2, from the tracker's noise alone
};

// Twist of T (base axes) that takes the predicted pose to the measured one: [p_m - p; log(R_m R^T)], m and rad.
Twist residualTwist(const Pose& measured_X_BT, const Pose& predicted_X_BT);

// The pure force at T that explains a residual twist best, by least squares weighted with the tracker's noise on
// residual = C [f; 0]. C: tangent compliance of T, base axes, not singular in its first three columns. Linear: good
// for deflections that are small against the robot; model error and creep are taken for force.
TipForce estimateTipForce(const Matrix6& C, const Twist& residual, const TrackerNoise& noise = {});

}  // namespace live_stiffness
