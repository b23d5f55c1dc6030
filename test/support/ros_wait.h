#pragma once
// Waiting for a condition while callbacks run; never a fixed sleep.

#include <ros/callback_queue.h>
#include <ros/ros.h>

namespace live_stiffness {

// Spins until the condition holds; false after timeout_s seconds of wall time.
template <class Condition>
bool waitFor(Condition condition, double timeout_s = 20.0) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(timeout_s);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    if (condition()) return true;
  }
  return false;
}

}  // namespace live_stiffness
