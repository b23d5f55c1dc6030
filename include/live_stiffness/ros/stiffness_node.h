#pragma once
// The node: inputs, estimator, outputs. No mathematics and no message fields here.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>
#include <vector>

#include "live_stiffness/estimation/tip_force.h"
#include "live_stiffness/ros/markers.h"
#include "live_stiffness/ros/node_parameters.h"
#include "live_stiffness/ros/pressure_input.h"
#include "live_stiffness/ros/tracker_input.h"

namespace live_stiffness {

class StiffnessNode {
 public:
  // Subscribes and advertises. Throws ConfigurationError with every fault of the parameters.
  StiffnessNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

 private:
  void onPressures(const Pressures& pressures, const ros::Time& stamp);
  void onPressureFault(const std::string& fault);
  void onMeasuredTip(const Pose& measured_X_BT, const ros::Time& stamp);
  void onTipWrench(const geometry_msgs::WrenchStamped::ConstPtr& message);
  void onHeartbeat(const ros::TimerEvent&);
  void onMarkers(const ros::TimerEvent&);

  void expireTipWrench();
  void react(StiffnessEstimator::Outcome outcome);
  bool isStale() const { return !newest_fault_.empty() || pressure_input_.isStale(); }
  void publishEstimate();
  void diagnoseSolver(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseTracker(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle node_, private_node_;
  NodeParameters parameters_;
  StiffnessEstimator estimator_;
  MarkerStyle marker_style_;
  ros::Publisher estimate_publisher_, tip_pose_publisher_, backbone_publisher_, marker_publisher_, error_publisher_,
      wrench_publisher_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;
  tf2_ros::StaticTransformBroadcaster static_tf_broadcaster_;
  diagnostic_updater::Updater diagnostics_;

  ros::Time pressure_stamp_;  // of the newest usable pressures
  ros::Time estimate_stamp_;  // of the pressures of the last good estimate
  ros::Time tf_stamp_;        // of the last transform sent; tf refuses the same stamp twice
  std::string newest_fault_;  // why the estimate is not that of the newest pressures; empty: it is
  double tracking_error_ = 0.0;  // newest distance, m

  // Last, so that no callback runs before the rest exists.
  InputWatch wrench_watch_;
  PressureInput pressure_input_;
  TrackerInput tracker_input_;
  ros::Subscriber wrench_subscriber_;
  std::vector<ros::Timer> timers_;
  ros::WallTimer diagnostics_timer_;  // wall time: a paused or missing clock is just what it must report
};

}  // namespace live_stiffness
