#pragma once
// Compliance between any two sections of a loaded robot: a wrench at one, the twist of the other. Shi et al. give it
// for wrench and twist at the tip; docs/derivation.md, section 8, extends it to all sections.

#include <vector>

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

// Where a wrench acts or a twist is wanted: a section of a segment, or the tip point T. For a point that is fixed to a
// section, as on a rigid link, apply twistShift() to the result for that section.
struct SectionPlace {
  int segment = kTip;     // 0 to segmentCount() - 1, or kTip
  double fraction = 1.0;  // of the segment's length, 0 to 1; ignored for kTip

  static constexpr int kTip = -1;
};

class GeneralisedCompliance {
 public:
  // Linearises the equilibrium that the last successful solve left in `workspace`. tip_wrench: that of this solve.
  // Throws ConfigurationError for a segment that the scene does not have or a fraction outside 0 to 1. All is
  // copied; the workspace may be used again.
  GeneralisedCompliance(const StiffnessModel& model, const StiffnessWorkspace& workspace, const Wrench& tip_wrench,
                        const std::vector<SectionPlace>& places);

  // False if the iteration on a part of the robot did not converge, or the tangent is singular (at the buckling load).
  bool ok() const { return ok_; }

  // Small twist of place `to` (of its origin, base axes) by a dead wrench at place `from` (at its origin, base axes),
  // 6x6; arguments are indices into the places given. From tip to tip it is StiffnessSolution::compliance. Without a dead
  // tip moment, from b to a is the transpose of from a to b (Maxwell and Betti). Without any load it is the material
  // compliance up to the place nearer to the base, shifted. Zero unless ok().
  Matrix6 between(int from, int to) const;
  // Pose of a place in B.
  const Pose& pose(int place) const { return stops_[stop_of_place_[place]].X; }

 private:
  // Linear map from a change of state [phi; dp; dm; df] (rotation, rad; position, m; moment, N m; force, N; base axes), where
  // the force is that which acts all along, to the change of state at a later section.
  using Transfer = Eigen::Matrix<double, 12, 12>;
  // A section at which the state is wanted. Transfers: from the base, and from the stop before (or the base).
  struct Stop {
    Pose X;
    Transfer from_base, from_last;
  };
  class Walk;

  bool ok_ = true;
  std::vector<Stop> stops_;  // in the order of the chain; the last one is T
  std::vector<int> stop_of_place_;
};

}  // namespace live_stiffness
