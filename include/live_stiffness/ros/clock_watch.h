#pragma once
// Health of ROS time, for diagnostics: simulated time that has not begun, stands still or jumps back.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/time.h>

namespace live_stiffness {

class ClockWatch {
 public:
  // To be called by wall time: where time stands still, no timer of ROS time fires.
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  ros::Time last_;               // at the last call
  double jump_ = 0.0;            // how far time last jumped back, s
  ros::WallTime jumped_, moved_;  // when it did, and when it was last seen to advance
};

}  // namespace live_stiffness
