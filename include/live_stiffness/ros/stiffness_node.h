#pragma once
// The node: inputs, estimator, outputs. No mathematics and no message fields here.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <memory>
#include <string>
#include <vector>

#include "live_stiffness/ros/clock_watch.h"
#include "live_stiffness/ros/contact_output.h"
#include "live_stiffness/ros/markers.h"
#include "live_stiffness/ros/node_parameters.h"
#include "live_stiffness/ros/pose_output.h"
#include "live_stiffness/ros/pressure_input.h"
#include "live_stiffness/ros/registration_service.h"
#include "live_stiffness/ros/stiffness_services.h"
#include "live_stiffness/ros/tip_handle.h"
#include "live_stiffness/ros/tracker_input.h"
#include "live_stiffness/ros/wrench_input.h"

namespace live_stiffness {

class StiffnessNode {
 public:
  // Subscribes and advertises. Throws ConfigurationError with every fault of the parameters.
  StiffnessNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

 private:
  void onPressures(const Pressures& pressures, const ros::Time& stamp);
  void onTracked(const Pose& X_AS, const Pose& measured_X_BT, const ros::Time& stamp);
  void onHeartbeat(const ros::TimerEvent&);
  void onMarkers(const ros::TimerEvent&);

  NewestEstimate newest() const { return {estimator_.estimate(), estimate_stamp_, isStale()}; }
  void react(StiffnessEstimator::Outcome outcome);
  // Why the estimate is not that of the newest pressures; empty: it is.
  std::string newestFault() const { return input_fault_.empty() ? estimator_.statusText() : input_fault_; }
  bool isStale() const { return !newestFault().empty() || pressure_input_.isStale(); }
  void publishEstimate();
  void diagnoseSolver(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseTracker(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle node_, private_node_;
  NodeParameters parameters_;
  StiffnessEstimator estimator_;
  PoseOutput pose_output_;
  MarkerStyle marker_style_;
  ros::Publisher estimate_publisher_, backbone_publisher_, marker_publisher_, error_publisher_;
  ContactOutput contact_;
  ClockWatch clock_watch_;
  diagnostic_updater::Updater diagnostics_;

  ros::Time pressure_stamp_;  // of the newest usable pressures
  ros::Time estimate_stamp_;  // of the pressures of the last good estimate
  std::string input_fault_;   // why the newest pressures cannot even be read; empty: they can
  double tracking_error_ = 0.0;  // newest distance, m

  // Last, so that no callback runs before the rest exists.
  WrenchInput wrench_input_;
  PressureInput pressure_input_;
  TrackerInput tracker_input_;
  StiffnessServices services_;
  RegistrationService registration_;
  std::unique_ptr<TipHandle> tip_handle_;  // none unless enabled
  std::vector<ros::Timer> timers_;
  ros::WallTimer diagnostics_timer_;  // wall time: a paused or missing clock is just what it must report
};

}  // namespace live_stiffness
