#pragma once
// Angles and rotation vectors at which every function of the Lie groups is tested.

#include <vector>

#include "live_stiffness/lie/angle_functions.h"
#include "support/random_source.h"

namespace live_stiffness {

// Zero, denormal, where squares underflow, where digits of 1 - cos go, on both sides of each switch, up to `largest`
// (rad); 2 pi - 0.08 is the last.
inline std::vector<double> sampleAngles(double largest) {
  std::vector<double> angles;
  for (double angle : {0.0, 5e-324, 1e-310, 1e-300, 1e-160, 1e-80, 1e-20, 1e-12, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.1,
                       0.5, 0.999999, 1.000001, kSeriesBelowAngle * (1 - 1e-12), kSeriesBelowAngle,
                       kSeriesBelowAngle * (1 + 1e-12), 1.7, 2.0, 2.5, 3.0, 3.1, kPi - 1e-6, kPi, kPi + 1e-6, 3.5,
                       4.5, 5.5, 6.0, 6.2})
    if (angle <= largest) angles.push_back(angle);
  return angles;
}

// Vectors of those lengths, each along four random directions.
inline std::vector<Vector3> sampleRotations(double largest) {
  RandomSource random(11);
  std::vector<Vector3> vectors;
  for (double angle : sampleAngles(largest))
    for (int i = 0; i < 4; ++i) vectors.push_back(random.direction(angle));
  return vectors;
}

// Each switch, and angles around it at which both branches are good to rounding.
constexpr double kAroundSwitch[] = {0.95, 0.999, 1.0, 1.001, 1.05};
// Values of a switch argument that force a series or a closed form at any angle.
constexpr double kForceSeries = 1e3, kForceClosedForm = 0.0;

}  // namespace live_stiffness
