#pragma once
// Creep of a segment under pressure: one exponential mode, in front of the static model.
//
// After a step of pressure, a share a of the effect comes later, with the time constant tau. The model gets
//   P_eff = (1 - a) P + a y,   tau dy/dt = P - y.
// T is double, or a type that carries derivatives.

#include <cmath>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

template <class T>
class CreepFilterOf {
 public:
  using Values = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  // share: 0 to below 1; time: s, positive.
  CreepFilterOf(const T& share, const T& time) : share_(share), time_(time) {}

  // Effective pressures, Pa, for pressures that were constant since the last call, `elapsed` s ago. The first call puts the
  // filter into its steady state, as if its pressures had been there for a long time. Allocates only then.
  const Values& update(PressuresRef pressures, double elapsed) {
    using std::exp;
    if (late_.size() != pressures.size()) late_ = pressures.cast<T>();
    else late_ += (pressures.cast<T>() - late_) * T(1.0 - exp(-elapsed / time_));
    effective_ = pressures.cast<T>() * T(1.0 - share_) + late_ * share_;
    return effective_;
  }
  void reset() { late_.resize(0); }

 private:
  T share_, time_;
  Values late_, effective_;  // y and P_eff, Pa
};
using CreepFilter = CreepFilterOf<double>;

}  // namespace live_stiffness
