#pragma once
// Where the platform is about, for a start without a last solution.

#include "live_stiffness/parallel/parallel_scene.h"

namespace live_stiffness {

// Length of a smooth curve (a cubic) from the rod's hole in the base to its place on the platform at X_BP, leaving both
// along the rod, m: about what the rod needs.
double lengthOfCurve(const ParallelRod& rod, const Pose& X_BP);

// Pose of the platform at which such curves have about these lengths (m, one a rod), by damped least squares from the
// pose that fits straight rods best. Finite for finite lengths.
Pose guessPlatformPose(const ParallelScene& scene, const std::vector<double>& lengths);

}  // namespace live_stiffness
