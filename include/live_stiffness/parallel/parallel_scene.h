#pragma once
// A parallel continuum robot: flexible rods from a base to one rigid platform, each pushed or pulled through the base,
// so that its length is the input (Appendix E; Black et al. 2017). Plain data; see parallel_scene_file.h for YAML.

#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/lie/se3.h"
#include "live_stiffness/section/cross_section.h"

namespace live_stiffness {

// A rod, straight when unloaded, clamped at both ends. The frames of its ends have z along the rod; if both have the same
// orientation the rod is not twisted.
struct ParallelRod {
  CrossSection section;  // without chambers
  Pose X_BD;             // where it leaves the base, m
  Pose X_PE;             // where the platform holds its end, m
};

// Frame P is fixed to the platform; its origin is the point that poses and compliances are about.
struct ParallelScene {
  std::vector<ParallelRod> rods;
  std::optional<Vector3> gravity;              // m/s^2, base axes; none: weightless
  double platform_mass = 0.0;                  // kg
  Vector3 platform_centre = Vector3::Zero();   // centre of mass in P, m

  int rodCount() const { return static_cast<int>(rods.size()); }
  Vector3 platformWeight() const { return platform_mass * gravity.value_or(Vector3::Zero()); }  // N, base axes
};

}  // namespace live_stiffness
