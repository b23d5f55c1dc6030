#pragma once
// Diagnostics of both nodes: their updater and entries for clock and solver.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <string>

#include "ros/parsed.h"

namespace live_stiffness {

// Publishes diagnostics, with an entry for ROS time: simulated time that has not begun, stands still or jumped back.
class NodeDiagnostics : public diagnostic_updater::Updater {
 public:
  NodeDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node) : Updater(node, private_node) {
    setHardwareID("live_stiffness");
    add("Clock", this, &NodeDiagnostics::diagnoseClock);
    // Not update(), which waits for ROS time: that may stand still or jump back (findings/diagnostics_after_a_jump_of_time.sh).
    timer_ = node.createWallTimer(ros::WallDuration(getPeriod()), [this](const ros::WallTimerEvent&) { force_update(); });
  }

 private:
  void diagnoseClock(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    const ros::WallDuration shown(2.0), longest(0.5);
    const double jump = -0.5;  // smaller jumps are corrections of the wall clock
    const ros::Time now = ros::Time::now();
    const ros::WallTime wall = ros::WallTime::now();
    if (secondsBetween(last_, now) < jump) jumped_ = wall;
    if (now != last_) moved_ = wall;
    last_ = now;
    if (now.isZero()) status.summary(DiagnosticStatus::WARN, "simulated time has not begun: nothing publishes /clock");
    else if (wall - moved_ > longest) status.summary(DiagnosticStatus::WARN, "simulated time stands still");
    else if (wall - jumped_ < shown) status.summary(DiagnosticStatus::WARN, "time jumped back: older input is forgotten");
    else status.summary(DiagnosticStatus::OK, "ok");
    status.add("simulated", !ros::Time::isSystemTime());
  }

  ros::Time last_;                // at the last call
  ros::WallTime jumped_, moved_;  // when it jumped back, and when it was last seen to advance
  ros::WallTimer timer_;
};

// Status of the solver. estimator: StiffnessEstimator or ParallelEstimator. wrench_error: what is wrong with the known wrench,
// or empty.
template <class Estimator>
void reportSolver(const Estimator& estimator, const std::string& wrench_error,
                  diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!estimator.status().ok())
    status.summary(DiagnosticStatus::ERROR, estimator.statusText());
  else if (estimator.estimate() == nullptr)
    status.summary(DiagnosticStatus::WARN, "nothing solved yet");
  else if (!wrench_error.empty())
    status.summary(DiagnosticStatus::WARN, wrench_error);
  else
    status.summary(DiagnosticStatus::OK, "ok");
  if (estimator.estimate() == nullptr) return;
  status.add("solve time (us)", 1e6 * estimator.estimate()->solve_time);
  status.add("iterations", estimator.estimate()->solution.iterations);
  status.add("numerical error", estimator.estimate()->solution.numerical_error);
}

}  // namespace live_stiffness
