#pragma once
// Creep under pressure: one exponential mode, in front of the static model.
//
// After a step of pressure, a share a of the effect comes later, with the time constant tau. The model gets
//   P_eff = (1 - a) P + a y,   tau dy/dt = P - y.

#include "live_stiffness/conventions.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

// Creep of a whole robot for a stream of stamped pressures: the effective pressures that the static model gets.
// As in calibration, the creep of the first segment holds for all.
class SceneCreep {
 public:
  explicit SceneCreep(const Scene& scene);

  bool exists() const { return share_ > 0.0; }
  // Effective pressures (Pa, one per chamber) at `time` (s) for pressures measured then, that were constant since the last
  // call. The first call starts in the steady state, as if its pressures had been there for a long time, and so does a call
  // whose time is more than a second earlier than the last one (a clock that was set back). A time that is earlier by less
  // counts as the same time. Allocates only in a first call.
  const Pressures& update(PressuresRef pressures, double time);
  // The next call is the first again.
  void reset() { late_.resize(0); }

 private:
  double share_, time_constant_;  // -, s
  double time_ = 0.0;             // s, of the last call
  Pressures late_, effective_;    // y and P_eff, Pa
};

}  // namespace live_stiffness
