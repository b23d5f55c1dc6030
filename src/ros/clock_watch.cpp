#include "ros/clock_watch.h"

#include <utility>

namespace live_stiffness {

void ClockWatch::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  constexpr double kJump = 0.5;  // s back; less is a wall clock being corrected
  const ros::WallDuration shown(2.0), patience(0.5);
  const ros::Time now = ros::Time::now();
  const ros::WallTime wall = ros::WallTime::now();
  if ((now - last_).toSec() < -kJump) {
    jump_ = (last_ - now).toSec();
    jumped_ = wall;
    has_jumped_ = true;
  }
  if (now != last_) moved_ = wall;
  last_ = now;
  if (now.isZero())
    status.summary(DiagnosticStatus::WARN, "simulated time has not begun: nothing publishes /clock (use_sim_time is set)");
  else if (wall - moved_ > patience)
    status.summaryf(DiagnosticStatus::WARN, "simulated time stands still for %.1f s: is the bag paused?",
                    (wall - moved_).toSec());
  else if (wall - jumped_ < shown)
    status.summaryf(DiagnosticStatus::WARN, "time jumped back by %.1f s: a bag in a loop? Older input is forgotten", jump_);
  else
    status.summary(DiagnosticStatus::OK, "ok");
  status.add("simulated", !ros::Time::isSystemTime());
  status.add("now (s)", now.toSec());
}

void ClockWatch::restartAfterJump(std::vector<ros::Timer>& timers) {
  if (!std::exchange(has_jumped_, false)) return;
  for (ros::Timer& timer : timers) {
    timer.stop();
    timer.start();
  }
}

}  // namespace live_stiffness
