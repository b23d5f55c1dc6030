#pragma once
// The smooth step that levels of the simulated rig are joined by.

#include <algorithm>

namespace live_stiffness {

// 0 up to x = 0, 1 from x = 1 on, with zero velocity and acceleration at both ends.
inline double quinticBlend(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

}  // namespace live_stiffness
