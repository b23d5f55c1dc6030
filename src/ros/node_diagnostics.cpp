// Diagnostics of a StiffnessNode.

#include <diagnostic_updater/diagnostic_updater.h>
#include <diagnostic_updater/update_functions.h>

#include "ros/shared_diagnostics.h"
#include "ros/stiffness_node.h"

namespace live_stiffness {

using Status = diagnostic_updater::DiagnosticStatusWrapper;

struct StiffnessNode::Diagnostics {
  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, double heartbeat)
      : updater(node, private_node), lowest_rate(heartbeat) {}

  diagnostic_updater::Updater updater;
  ClockStatus clock;
  double lowest_rate, highest_rate = 1e5;  // of estimates, Hz
  diagnostic_updater::FrequencyStatus frequency{{&lowest_rate, &highest_rate}, "Estimates"};
  // Of pressures when their estimate is published: at most 0.1 s ahead, at most 1 s behind.
  diagnostic_updater::TimeStampStatus time_stamps{{-0.1, 1.0}, "Time stamps"};
  ros::WallTimer timer;
};

void StiffnessNode::countPublished(bool is_stale) {
  diagnostics_->frequency.tick();
  if (!is_stale) diagnostics_->time_stamps.tick(estimate_stamp_);
}

void StiffnessNode::addDiagnostics() {
  diagnostics_ = std::make_shared<Diagnostics>(node_, private_node_, parameters_.heartbeat);
  diagnostic_updater::Updater& updater = diagnostics_->updater;
  updater.setHardwareID("live_stiffness");
  updater.add("Pressures", [this](Status& status) {
    const Lock lock(estimation_mutex_);
    pressure_input_.status().diagnose(estimator_->statusText(), status);
  });
  updater.add("Tracker", [this](Status& status) {
    const Lock lock(tracking_mutex_);
    tracker_input_.diagnose(status);
    status.add("tracking error (mm)", 1e3 * tracking_error_);
  });
  updater.add("Contact", [this](Status& status) {
    const Lock lock(tracking_mutex_);
    contact_.diagnose(status);
  });
  updater.add("Solver", [this](Status& status) {
    const Lock lock(estimation_mutex_);
    status.add("model", modelName(parameters_.model) + ", " + steppingName(parameters_.model.stepping));
    reportSolver(*estimator_, wrench_input_.error(), status);
    if (is_paused_) status.summary(diagnostic_msgs::DiagnosticStatus::WARN, newestError());
  });
  updater.add("Clock", &diagnostics_->clock, &ClockStatus::diagnose);
  updater.add(diagnostics_->frequency);
  updater.add(diagnostics_->time_stamps);
  // Not update(), which waits for ROS time: that may stand still or jump back (findings/diagnostics_after_a_jump_of_time.sh).
  diagnostics_->timer = node_.createWallTimer(ros::WallDuration(updater.getPeriod()), [this](const ros::WallTimerEvent&) {
    diagnostics_->updater.force_update();
  });
}

}  // namespace live_stiffness
