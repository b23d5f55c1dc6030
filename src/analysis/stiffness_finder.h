#pragma once
// The pressures that hold the tip at a point and make it stiffest, or most compliant, along a direction. A robot with more
// than three channels reaches most points with many combinations of pressures.

#include <cstdint>

#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

struct FinderOptions {
  double max_pressure = 1e5;  // every channel is kept within 0 and this, Pa
  double tolerance = 1e-4;    // largest distance from the point, m
  int starts = 24;            // random starts (fixed seed), in addition to the middle of the range
  std::uint64_t seed = 1;
};

struct FoundPressures {
  Pressures channels;     // gauge, Pa
  Pose X_BT;
  double miss = 0.0;      // distance of the tip from the point, m
  double stiffness = 0.0;  // free stiffness along the direction through the tip, 1 / (d^T C d), tangent, N/m
};

struct FinderResult {
  bool solvable = false;   // a configuration was solved at all; false: nothing below holds
  bool reached = false;    // `stiffest` and `softest` hold
  FoundPressures nearest;  // the tip as near to the point as was found
  FoundPressures stiffest, softest;
  long solves = 0;
};

// Tip to `point` (base axes, m), stiffness along `direction` (base axes, not zero). Each start is first brought to the
// point by damped least squares within the bounds; if none succeeds, the point is considered out of reach. From each that
// succeeds, sequential quadratic programming (SLSQP of NLopt: D. Kraft, "A software package for sequential
// quadratic programming", DFVLR-FB 88-28, 1988) then improves the logarithm of the stiffness, with the tip
// held at the point, by central differences. Both methods are local: the best result of all starts is returned, which may not
// be the global optimum. Differences need a smooth model; the steps of Stepping::kFixedStep change in
// number with the pressures and make it jump, so use kContinuous or kLinear. Throws ConfigurationError on bad options,
// a point or direction that is not finite, and channels that do not fit the scene.
FinderResult findPressures(const StiffnessModel& model, const ChannelMap& channels, const Vector3& point,
                           const Vector3& direction, const FinderOptions& options);

}  // namespace live_stiffness
