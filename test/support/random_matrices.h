#pragma once
// Random rigid poses and positive definite matrices with units, of any conditioning.

#include <cmath>

#include "live_stiffness/lie/se3.h"
#include "support/random_source.h"

namespace live_stiffness {

inline Pose randomPose(RandomSource& random, double distance) {
  const Vector3 turn = random.direction(random.uniform(0.0, 3.0));
  return {expSo3(turn), random.direction(distance)};
}

// Stiffness of six screw springs of coefficients up to `spread` apart, lines within `length` of the origin and pitches
// of its order; N/m about 1.
inline Matrix6 randomStiffness(RandomSource& random, double length, double spread) {
  Matrix6 K = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vector3 n = random.direction(1.0), r = random.vector(length);
    Vector6 w;
    w << n, r.cross(n) + random.uniform(0.3, 1.0) * length * (i % 2 ? 1.0 : -1.0) * n;
    K += std::pow(spread, random.uniform(-1.0, 0.0)) * w * w.transpose();
  }
  return K;
}

}  // namespace live_stiffness
