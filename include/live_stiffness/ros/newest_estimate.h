#pragma once
// What a node knows about its robot at the moment, for those who ask it questions.

#include <ros/time.h>

#include <functional>

#include "live_stiffness/estimation/stiffness_estimator.h"

namespace live_stiffness {

struct NewestEstimate {
  const Estimate* estimate = nullptr;  // the last good one; nullptr before the first
  ros::Time stamp;                     // of its pressures
  bool stale = false;                  // it is not that of the newest pressures
};
using AskNewest = std::function<NewestEstimate()>;

}  // namespace live_stiffness
