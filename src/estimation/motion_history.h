#pragma once
// The recent past of pressures and predicted tip, since a late tracker measures where the tip was some time ago.

#include <deque>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

struct Moment {
  double time = 0.0;    // s
  Pressures pressures;  // gauge, Pa, one per chamber
  Pose X_BT;            // predicted tip, m
};

class MotionHistory {
 public:
  static constexpr double kCapacity = 2.0;  // s of the past
  static constexpr size_t kMost = 4000;     // moments kept: the newest ones

  // time: s. If it is more than a second earlier than the last one (a clock was set back), the history starts again; if it is
  // earlier by less, the moment is left out.
  void add(const Moment& moment);
  void clear() { moments_.clear(); }
  bool empty() const { return moments_.empty(); }

  // Interpolated; at the nearest end outside. The history must not be empty.
  Moment at(double time) const;

 private:
  std::deque<Moment> moments_;  // in order of time
};

}  // namespace live_stiffness
