#pragma once
// The accumulating policy (13) of Shi et al.: a segment's rest state carried along the *measured* history of its
// pressures, one increment (12), (15), (30) for each new measurement.
//
// It depends on the path and on its increments: explicit increments up and down again do not cancel, so that after a
// cycle which ends at zero pressure the segment is left bent and stretched. The product's own policy (load_stepping.h)
// starts every path at zero pressure and cannot drift; this one is here to be measured against it.

#include "section/load_stepping.h"

namespace live_stiffness {

class AccumulatedRestState {
 public:
  explicit AccumulatedRestState(const CrossSection& section);

  // One increment from the last pressures to these (gauge, Pa, one per chamber), with the section and the chamber
  // positions of the last state. False, and nothing changes, when the pressures are not finite or of the wrong number,
  // or when the increment would end where the section has no positive area.
  bool advanceTo(PressuresRef pressures);

  const RestState& state() const { return state_; }

  // Back to the straight segment at zero pressure.
  void reset();

 private:
  CrossSection section_;
  SectionMoments moments_;
  RestState state_;
  double force_ = 0.0;                 // F_P of the last pressures, N
  Vector3 moment_ = Vector3::Zero();   // T_P of the last pressures with d_k at stretch 1, N m, section axes
};

}  // namespace live_stiffness
