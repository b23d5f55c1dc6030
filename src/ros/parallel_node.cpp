#include "live_stiffness/ros/parallel_node.h"

namespace live_stiffness {
namespace {

using diagnostic_msgs::DiagnosticStatus;

}  // namespace

ParallelNode::ParallelNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : node_(node),
      private_node_(private_node),
      parameters_(loadParallelParameters(private_node)),
      estimator_(parameters_.scene, parameters_.model),
      diagnostics_(node, private_node),
      length_input_(
          node,
          {"rod_lengths", "rod lengths", "rod lengths", "", parameters_.scene.rodCount(), parameters_.length_timeout},
          [this](const topic_tools::ShapeShifter& message) { return readRodLengths(message, parameters_.length_unit); },
          [this](const Eigen::VectorXd& lengths, const ros::Time& stamp) { onLengths(lengths, stamp); },
          [this](const std::string& fault) { input_fault_ = fault; }),
      wrench_input_(
          node, "platform_wrench", parameters_.frames, parameters_.wrench_timeout,
          [this] { return estimator_.estimate() ? &estimator_.estimate()->solution.X_BP : nullptr; },
          [this](const Wrench& wrench) { onWrench(wrench); }) {
  estimate_publisher_ = private_node_.advertise<PlatformEstimate>("estimate", 10);
  pose_publisher_ = private_node_.advertise<geometry_msgs::PoseStamped>("platform_pose", 10);
  marker_publisher_ = private_node_.advertise<visualization_msgs::MarkerArray>("markers", 1);
  diagnostics_.setHardwareID("live_stiffness");
  diagnostics_.add("Rod lengths", &length_input_, &ArrayInput::diagnose);
  diagnostics_.add("Solver", this, &ParallelNode::diagnoseSolver);
  timers_ = {node_.createTimer(ros::Duration(1.0 / parameters_.heartbeat), &ParallelNode::onHeartbeat, this),
             node_.createTimer(ros::Duration(1.0 / parameters_.marker_rate), &ParallelNode::onMarkers, this)};
  diagnostics_timer_ = node_.createWallTimer(ros::WallDuration(0.2),
                                             [this](const ros::WallTimerEvent&) { diagnostics_.update(); });
  ROS_INFO("%d rods", parameters_.scene.rodCount());
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
  if (message.stale) return;
  pose_publisher_.publish(toPoseStamped(estimate.solution.X_BP, estimate_stamp_, parameters_.frames.base));
  if (estimate_stamp_ == tf_stamp_) return;
  tf_stamp_ = estimate_stamp_;
  tf_broadcaster_.sendTransform(
      toTransform(estimate.solution.X_BP, estimate_stamp_, parameters_.frames.base, parameters_.frames.body));
}

void ParallelNode::onHeartbeat(const ros::TimerEvent&) {
  length_input_.tend();
  wrench_input_.tend();
  if (isStale()) publishEstimate();
}

void ParallelNode::onMarkers(const ros::TimerEvent&) {
  if (estimator_.estimate() == nullptr) return;
  marker_publisher_.publish(makeParallelMarkers(*estimator_.estimate(), parameters_.scene, isStale(),
                                                parameters_.style, estimate_stamp_));
}

void ParallelNode::diagnoseSolver(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (!estimator_.status().ok())
    status.summary(DiagnosticStatus::ERROR, estimator_.statusText());
  else if (estimator_.estimate() == nullptr)
    status.summary(DiagnosticStatus::WARN, "nothing solved yet");
  else if (!wrench_input_.fault().empty())
    status.summary(DiagnosticStatus::WARN, wrench_input_.fault());
  else
    status.summary(DiagnosticStatus::OK, "ok");
  if (estimator_.estimate() == nullptr) return;
  const ParallelEstimate& estimate = *estimator_.estimate();
  status.add("solve time (us)", 1e6 * estimate.solve_time);
  status.add("iterations", estimate.solution.iterations);
  status.add("numerical error", estimate.solution.numerical_error);
}

}  // namespace live_stiffness
