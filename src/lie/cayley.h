#pragma once
// Cayley vectors (Gibbs, Rodrigues): g = 2 tan(t / 2) axis of a rotation by t. Rotation and rate are rational in g:
// no branch, no trigonometry, and no digit lost at any angle below half a turn, where g becomes infinite.

#include <Eigen/Geometry>

#include "live_stiffness/lie/so3.h"

namespace live_stiffness {

// Rotation matrix of the Cayley vector g (-): I + f (hat(g) + hat(g)^2 / 2) with f = 4 / (4 + |g|^2).
// The factor 2 in g makes it agree with the rotation vector to second order.
inline Matrix3 cayleySo3(const Vector3& g) {
  const double f = 4.0 / (4.0 + g.squaredNorm());
  const Vector3 a = f * g, b = 0.5 * a;
  const double bxx = b.x() * g.x(), byy = b.y() * g.y(), bzz = b.z() * g.z();
  const double bxy = b.x() * g.y(), bxz = b.x() * g.z(), byz = b.y() * g.z();
  Matrix3 R;
  R << 1.0 - byy - bzz, bxy - a.z(), bxz + a.y(),
       bxy + a.z(), 1.0 - bxx - bzz, byz - a.x(),
       bxz - a.y(), byz + a.x(), 1.0 - bxx - byy;
  return R;
}

// Cayley vector of R: twice the vector over the scalar of its quaternion. At half a turn it is huge or infinite. (Not
// from 2 (R - R^T) / (1 + tr R), whose denominator cancels towards half a turn.)
inline Vector3 inverseCayleySo3(const Matrix3& R) {
  const Eigen::Quaterniond q(R);
  return 2.0 / q.w() * q.vec();
}

// With R(s) = R0 cayleySo3(g(s)) and R' = R hat(u): the rate g' = u + g x u / 2 + g (g . u) / 4. For a rate in fixed
// axes, R' = hat(u) R, the cross product changes its sign.
inline Vector3 bodyRateToCayleyRate(const Vector3& g, const Vector3& u) {
  return u + 0.5 * g.cross(u) + (0.25 * g.dot(u)) * g;
}

}  // namespace live_stiffness
