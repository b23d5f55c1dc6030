#pragma once
// The rotation group SO(3): exponential, logarithm and the derivative of the exponential.

#include <Eigen/Geometry>

#include "live_stiffness/conventions.h"
#include "live_stiffness/lie/angle_functions.h"

namespace live_stiffness {

// Skew matrix: hat(x) y = x cross y. Shi et al. (45).
inline Matrix3 hat(const Vector3& x) {
  Matrix3 x_hat;
  x_hat << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return x_hat;
}

// Rotation matrix of the rotation vector w (rad): I + a hat(w) + b hat(w)^2.
inline Matrix3 expSo3(const Vector3& w) {
  const double x = w.squaredNorm();
  const Vector3 aw = angleA(x) * w;
  const Vector3 bw = angleB(x) * w;
  const double bxx = bw.x() * w.x(), byy = bw.y() * w.y(), bzz = bw.z() * w.z();
  const double bxy = bw.x() * w.y(), bxz = bw.x() * w.z(), byz = bw.y() * w.z();
  Matrix3 R;
  R << 1.0 - byy - bzz, bxy - aw.z(), bxz + aw.y(),
       bxy + aw.z(), 1.0 - bxx - bzz, byz - aw.x(),
       bxz - aw.y(), byz + aw.x(), 1.0 - bxx - byy;
  return R;
}

// Rotation vector (rad, length <= pi) of R. At exactly pi the sign of the axis is arbitrary.
Vector3 logSo3(const Matrix3& R);

// Left Jacobian V(w) = I + b hat(w) + c hat(w)^2, the integral of exp(x hat(w)) over x in [0, 1].
Matrix3 leftJacobianSo3(const Vector3& w);

// With R(s) = R0 exp(hat(w(s))) and R' = R hat(u): the rate w' = (I + hat(w)/2 + d hat(w)^2) u, the inverse right
// Jacobian applied to u. Singular at |w| = 2 pi, so keep elements well below.
inline Vector3 bodyRateToVectorRate(const Vector3& w, const Vector3& u) {
  const Vector3 w_cross_u = w.cross(u);
  return u + 0.5 * w_cross_u + angleD(w.squaredNorm()) * w.cross(w_cross_u);
}

}  // namespace live_stiffness
