#pragma once
// Health of ROS time, for diagnostics: simulated time that has not begun, stands still or jumps back.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/time.h>
#include <ros/timer.h>

#include <vector>

namespace live_stiffness {

class ClockWatch {
 public:
  // To be called by wall time: where time stands still, no timer of ROS time fires.
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  // Starts timers of ROS time anew if diagnose() has seen time jump back since the last call; empty ones are left alone.
  // roscpp itself misses a jump that comes just between two of its looks at the clock (TimerManager), and its timers then
  // wait until the time of before comes again.
  void restartAfterJump(std::vector<ros::Timer>& timers);

 private:
  ros::Time last_;               // at the last call
  double jump_ = 0.0;            // how far time last jumped back, s
  bool has_jumped_ = false;      // and the timers do not know yet
  ros::WallTime jumped_, moved_;  // when it did, and when it was last seen to advance
};

}  // namespace live_stiffness
