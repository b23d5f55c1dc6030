#pragma once
// Cayley vector of a rotation: 2 tan(angle / 2) times its axis, without a transcendental function. Below half a turn only.

#include "live_stiffness/lie/so3.h"

namespace live_stiffness {

inline Vector3 cayleyVector(const Matrix3& R) {
  return 2.0 / (1.0 + R.trace()) * Vector3(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

// I + 4 / (4 + |g|^2) (hat(g) + hat(g)^2 / 2).
inline Matrix3 cayleyRotation(const Vector3& g) {
  const Matrix3 x = hat(g);
  return Matrix3::Identity() + 4.0 / (4.0 + g.squaredNorm()) * (x + 0.5 * x * x);
}

}  // namespace live_stiffness
