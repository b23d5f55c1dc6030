#include "ros/parallel_node.h"

#include <optional>

#include "ros/parallel_markers.h"
#include "ros/solver_report.h"

namespace live_stiffness {

ParallelNode::ParallelNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : node_(node),
      private_node_(private_node),
      parameters_(loadParallelParameters(private_node)),
      estimator_(parameters_.scene, parameters_.model),
      pose_output_(private_node, "platform_pose", parameters_.frames),
      diagnostics_(node, private_node),
      length_input_(
          live_.handle(node),
          {"rod_lengths", "rod lengths", "rod lengths", "", parameters_.scene.rodCount(), parameters_.length_timeout},
          ArrayInput::subscribeTo<RodLengths>(
              [this](const auto& message) { return readRodLengths(message, parameters_.length_unit); }),
          [this](const Eigen::VectorXd& lengths, const ros::Time& stamp) { onLengths(lengths, stamp); },
          [this](const std::string& fault) { input_fault_ = fault; }),
      wrench_input_(
          live_.handle(node), "platform_wrench", parameters_.frames, parameters_.wrench_timeout,
          [this] { return estimator_.estimate() ? &estimator_.estimate()->solution.X_BP : nullptr; },
          [this](const Wrench& wrench) { onWrench(wrench); }) {
  estimate_publisher_ = private_node_.advertise<PlatformEstimate>("estimate", 10);
  marker_publisher_ = private_node_.advertise<visualization_msgs::MarkerArray>("markers", 1);
  addDiagnostics();
  timers_ = {live_.handle(node).createTimer(ros::Duration(1.0 / parameters_.heartbeat), &ParallelNode::onHeartbeat, this),
             node_.createTimer(ros::Duration(1.0 / parameters_.marker_rate), &ParallelNode::onMarkers, this)};
  ROS_INFO("%d rods", parameters_.scene.rodCount());
  live_.start("live_estimate", 0);
}

void ParallelNode::onLengths(const Eigen::VectorXd& lengths, const ros::Time& stamp) {
  length_stamp_ = stamp;
  input_fault_.clear();
  estimator_.setLengths({lengths.data(), lengths.data() + lengths.size()});
  react();
}

void ParallelNode::onWrench(const Wrench& wrench) {
  estimator_.setWrench(wrench);
  react();
}

void ParallelNode::react() {
  if (!estimator_.status().ok()) length_input_.reject(estimator_.statusText());
  else estimate_stamp_ = length_stamp_;
  publishEstimate();
}

// The last good estimate, with the truth about how good it still is.
void ParallelNode::publishEstimate() {
  if (estimator_.estimate() == nullptr) return;
  const ParallelEstimate& estimate = *estimator_.estimate();
  PlatformEstimate message = toEstimate(estimate, estimate_stamp_, parameters_.frames.base);
  setStanding(estimator_.status().code, newestFault(), length_input_.isStale(), parameters_.length_timeout,
              "rod lengths", message);
  estimate_publisher_.publish(message);
  if (!message.stale) pose_output_.publish(estimate.solution.X_BP, estimate_stamp_);
}

void ParallelNode::onHeartbeat(const ros::TimerEvent&) {
  length_input_.tend();
  wrench_input_.tend();
  if (isStale()) publishEstimate();
}

void ParallelNode::onMarkers(const ros::TimerEvent&) {
  std::optional<ParallelEstimate> newest;
  ros::Time stamp;
  bool stale;
  {
    const Lock lock(live_.mutex());
    if (estimator_.estimate() != nullptr) newest = *estimator_.estimate();
    stamp = estimate_stamp_;
    stale = isStale();
  }
  if (newest)
    marker_publisher_.publish(makeParallelMarkers(*newest, parameters_.scene, stale, parameters_.style, stamp));
}

void ParallelNode::addDiagnostics() {
  diagnostics_.setHardwareID("live_stiffness");
  diagnostics_.add("Rod lengths", [this](Status& status) {
    const Lock lock(live_.mutex());
    length_input_.diagnose(status);
  });
  diagnostics_.add("Solver", [this](Status& status) {
    const Lock lock(live_.mutex());
    reportSolver(estimator_, wrench_input_.fault(), status);
  });
  diagnostics_.add("Clock", &clock_watch_, &ClockWatch::diagnose);
  // Not update(): it waits for ROS time, which may stand still or jump back.
  diagnostics_timer_ = node_.createWallTimer(ros::WallDuration(diagnostics_.getPeriod()),
                                             [this](const ros::WallTimerEvent&) {
                                               diagnostics_.force_update();
                                               clock_watch_.restartAfterJump(timers_);
                                             });
}

}  // namespace live_stiffness
