#pragma once
// An approximate pose of the platform, for a cold start.

#include "live_stiffness/parallel/parallel_scene.h"

namespace live_stiffness {

// Length of a smooth curve (a cubic) from the rod's hole in the base to its place on the platform at X_BP, tangent to
// the rod at both, m: about the length of the rod.
double lengthOfCurve(const ParallelRod& rod, const Pose& X_BP);

// Pose of the platform at which such curves have about these lengths (m, one for each rod), by damped least squares from
// the pose that fits straight rods best. Finite for finite lengths.
Pose guessPlatformPose(const ParallelScene& scene, const std::vector<double>& lengths);

}  // namespace live_stiffness
