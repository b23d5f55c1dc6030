#pragma once
// Compliance between any two sections of a loaded robot: a wrench at one, the twist of the other. Shi et al. give it
// for a wrench and a twist at the tip; this is the tangent of docs/derivation.md, section 5, for both anywhere.

#include <vector>

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

// Where a wrench acts or a twist is asked for: a section of a segment, or the tip point T. A point that is fixed to a
// section, as on a rigid link, follows from its section by twistShift().
struct SectionPlace {
  int segment = kTip;     // 0 to segmentCount() - 1, or kTip
  double fraction = 1.0;  // of the segment's length, 0 to 1; ignored for kTip

  static constexpr int kTip = -1;
};

class GeneralisedCompliance {
 public:
  // Linearises the equilibrium that the last successful solve left in `workspace`. tip_wrench: that of this solve.
  // Throws ConfigurationError for a segment that the scene does not have or a fraction outside 0 to 1. The solve is
  // kept by copy; the workspace may go on.
  GeneralisedCompliance(const StiffnessModel& model, const StiffnessWorkspace& workspace, const Wrench& tip_wrench,
                        const std::vector<SectionPlace>& places);

  // False if the passes over a piece did not converge, or the tangent is singular (the brink of buckling).
  bool ok() const { return ok_; }

  // Small twist of place `to` (of its origin, base axes) by a dead wrench at place `from` (at its origin, base axes),
  // 6x6; indices into the places given. Between the tip and itself it is StiffnessSolution::compliance; as long as no
  // dead tip moment acts, from b to a is the transpose of from a to b (Maxwell and Betti); without any load it is the
  // material compliance up to the place nearer to the base, shifted. Zero unless ok().
  Matrix6 between(int from, int to) const;
  // Pose of a place in B.
  const Pose& pose(int place) const { return stops_[stop_of_place_[place]].X; }

 private:
  // How a change of state [phi; dp; dm] (rotation, rad; position, m; moment, N m; base axes), and of the force that
  // acts all along, arrives further on.
  struct Transfer {
    Eigen::Matrix<double, 9, 9> of_state = Eigen::Matrix<double, 9, 9>::Identity();
    Eigen::Matrix<double, 9, 3> of_force = Eigen::Matrix<double, 9, 3>::Zero();

    Transfer then(const Transfer& next) const {
      return {next.of_state * of_state, next.of_state * of_force + next.of_force};
    }
  };
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
