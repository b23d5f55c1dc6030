#pragma once
// Errors of rotations, and relative ones of poses and compliances, free of units: moments are scaled by a length of the
// robot.

#include <algorithm>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

// The larger of the position error over `length` (m) and the angle between the orientations (rad).
inline double poseError(const Pose& actual, const Pose& expected, double length) {
  const double angle = logSo3(actual.R * expected.R.transpose()).norm();
  return std::max((actual.p - expected.p).norm() / length, angle);
}

// By how much R is not a rotation: Frobenius norm of R^T R - I (52).
inline double orthonormalityError(const Matrix3& R) { return (R.transpose() * R - Matrix3::Identity()).norm(); }

// C with its moments scaled to forces at `length` (m): all of it in m/N.
inline Matrix6 scaledCompliance(Matrix6 C, double length) {
  C.rightCols<3>() *= length;
  C.bottomRows<3>() *= length;
  return C;
}

// Frobenius norm of the difference over that of the expected, scaled.
inline double complianceError(const Matrix6& actual, const Matrix6& expected, double length) {
  return scaledCompliance(actual - expected, length).norm() / scaledCompliance(expected, length).norm();
}

}  // namespace live_stiffness
