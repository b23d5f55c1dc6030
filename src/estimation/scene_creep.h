#pragma once
// Creep of a whole robot for a stream of stamped pressures: the effective pressures that the static model gets.

#include "estimation/creep.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

// As in calibration, the creep of the first segment holds for all; see estimation/creep.h.
class SceneCreep {
 public:
  explicit SceneCreep(const Scene& scene);

  bool exists() const { return share_ > 0.0; }
  // Effective pressures (Pa, one per chamber) at `time` (s) for pressures measured then. The first call starts in the
  // steady state, and so does a call whose time is more than a second earlier than the last one (a clock that was set back).
  // A time that is earlier by less counts as the same time.
  const Pressures& update(PressuresRef pressures, double time);
  // The next call is the first again.
  void reset() { filter_.reset(); }

 private:
  double share_;
  CreepFilter filter_;
  double time_ = 0.0;  // s, of the last call
};

}  // namespace live_stiffness
