#pragma once
// The node of a parallel robot: rod lengths in; pose and compliance of the platform, tf, markers and diagnostics out.
// No mathematics and no message fields here.
//
// The live lane takes inputs and publishes estimates; markers and diagnostics, on the global callback queue, look at its
// state under its mutex, so that they delay no estimate.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <mutex>
#include <string>
#include <vector>

#include "ros/array_input.h"
#include "ros/callback_lane.h"
#include "ros/clock_watch.h"
#include "ros/parallel_parameters.h"
#include "ros/pose_output.h"
#include "ros/wrench_input.h"

namespace live_stiffness {

class ParallelNode {
 public:
  // Subscribes and advertises. Throws ConfigurationError with every fault of the parameters.
  ParallelNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~ParallelNode() { live_.stop(); }

 private:
  using Lock = std::lock_guard<std::mutex>;
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  // On the live lane.
  void onLengths(const Eigen::VectorXd& lengths, const ros::Time& stamp);
  void onWrench(const Wrench& wrench);
  void react();
  // Why the estimate is not that of the newest lengths; empty: it is.
  std::string newestFault() const { return input_fault_.empty() ? estimator_.statusText() : input_fault_; }
  bool isStale() const { return !newestFault().empty() || length_input_.isStale(); }
  void publishEstimate();
  void onHeartbeat(const ros::TimerEvent&);

  // Elsewhere.
  void onMarkers(const ros::TimerEvent&);
  void addDiagnostics();

  CallbackLane live_;
  ros::NodeHandle node_, private_node_;
  ParallelParameters parameters_;
  ParallelEstimator estimator_;
  PoseOutput pose_output_;
  ros::Publisher estimate_publisher_, marker_publisher_;
  ClockWatch clock_watch_;
  diagnostic_updater::Updater diagnostics_;
  ros::Time length_stamp_;    // of the newest usable lengths
  ros::Time estimate_stamp_;  // of the lengths of the last good estimate
  std::string input_fault_;   // why the newest lengths cannot even be read; empty: they can

  // Last, so that no callback runs before the rest exists.
  ArrayInput length_input_;
  WrenchInput wrench_input_;
  std::vector<ros::Timer> timers_;
  ros::WallTimer diagnostics_timer_;  // wall time: a paused or missing clock is just what it must report
};

}  // namespace live_stiffness
