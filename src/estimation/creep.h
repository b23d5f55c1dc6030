#pragma once
// Creep under pressure: one exponential mode, in front of the static model.
//
// After a step of pressure, a share a of the effect comes later, with the time constant tau. The model gets
//   P_eff = (1 - a) P + a y,   tau dy/dt = P - y.

#include <cmath>

#include "live_stiffness/conventions.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

class CreepFilter {
 public:
  // share: 0 to below 1; time: s, positive.
  CreepFilter(double share, double time) : share_(share), time_(time) {}

  // Effective pressures, Pa, for pressures that were constant since the last call, `elapsed` s ago. The first call puts the
  // filter into its steady state, as if its pressures had been there for a long time. Allocates only then.
  const Pressures& update(PressuresRef pressures, double elapsed) {
    if (late_.size() != pressures.size()) late_ = pressures;
    else late_ += (pressures - late_) * (1.0 - std::exp(-elapsed / time_));
    effective_ = pressures * (1.0 - share_) + late_ * share_;
    return effective_;
  }
  void reset() { late_.resize(0); }

 private:
  double share_, time_;
  Pressures late_, effective_;  // y and P_eff, Pa
};

// Creep of a whole robot for a stream of stamped pressures: the effective pressures that the static model gets.
// As in calibration, the creep of the first segment holds for all.
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
