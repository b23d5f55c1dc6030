#pragma once
// Creep of a whole robot along a stream of stamped pressures: what the static model is to be given.

#include "live_stiffness/estimation/creep.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

// As in calibration, the creep of the first segment holds for all; see estimation/creep.h.
class SceneCreep {
 public:
  explicit SceneCreep(const Scene& scene);

  bool exists() const { return share_ > 0.0; }
  // Effective pressures (Pa, one per chamber) at `time` (s) of pressures measured then. The first call settles the
  // creep, and so does one that goes back in time by more than a second (a clock set anew); one that goes back by less
  // counts as no time at all.
  const Pressures& update(PressuresRef pressures, double time);

 private:
  double share_;
  CreepFilter filter_;
  double time_ = 0.0;  // s, of the last call
};

}  // namespace live_stiffness
