#include "live_stiffness/ros/stiffness_node.h"

#include "live_stiffness/ros/solver_report.h"

namespace live_stiffness {
namespace {

using diagnostic_updater::DiagnosticStatusWrapper;

constexpr int kBackboneSamples = 20;  // per segment

}  // namespace

StiffnessNode::StiffnessNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : node_(node),
      private_node_(private_node),
      parameters_(loadNodeParameters(private_node)),
      estimator_(parameters_.scene, parameters_.model, parameters_.estimator),
      pose_output_(private_node, "tip_pose", parameters_.frames),
      contact_(private_node, parameters_),
      diagnostics_(node, private_node),
      wrench_input_(
          node, "tip_wrench", parameters_.frames, parameters_.tip_wrench_timeout,
          [this] { return estimator_.estimate() ? &estimator_.estimate()->solution.X_BT : nullptr; },
          [this](const Wrench& wrench) { react(estimator_.setTipWrench(wrench)); }),
      pressure_input_(
          node, parameters_,
          [this](const Pressures& pressures, const ros::Time& stamp) { onPressures(pressures, stamp); },
          [this](const std::string& fault) { input_fault_ = fault; }),
      tracker_input_(node, parameters_,
                     [this](const Pose& X_AS, const Pose& measured_X_BT, const ros::Time& stamp) {
                       onTracked(X_AS, measured_X_BT, stamp);
                     }),
      services_(private_node, estimator_.model(), parameters_.frames, [this] { return newest(); }),
      registration_(private_node, estimator_.model(), parameters_,
                    [this](const Registration& registration) {
                      parameters_.registration = registration;
                      contact_.reset();
                    }) {
  marker_style_.frame = parameters_.frames.base;
  marker_style_.ellipsoid_scale = parameters_.ellipsoid_scale;
  estimate_publisher_ = private_node_.advertise<StiffnessEstimate>("estimate", 10);
  error_publisher_ = private_node_.advertise<TrackingError>("tracking_error", 10);
  backbone_publisher_ = private_node_.advertise<nav_msgs::Path>("backbone", 1);
  marker_publisher_ = private_node_.advertise<visualization_msgs::MarkerArray>("markers", 1);
  diagnostics_.setHardwareID("live_stiffness");
  diagnostics_.add("Pressures", &pressure_input_, &PressureInput::diagnose);
  diagnostics_.add("Tracker", this, &StiffnessNode::diagnoseTracker);
  diagnostics_.add("Contact", &contact_, &ContactOutput::diagnose);
  diagnostics_.add("Solver", this, &StiffnessNode::diagnoseSolver);
  diagnostics_.add("Clock", &clock_watch_, &ClockWatch::diagnose);
  if (parameters_.tip_handle.enabled)
    tip_handle_ = std::make_unique<TipHandle>(private_node_, estimator_.model(), marker_style_, parameters_.tip_handle,
                                              marker_publisher_, [this] { return newest(); });
  timers_ = {node_.createTimer(ros::Duration(1.0 / parameters_.heartbeat), &StiffnessNode::onHeartbeat, this),
             node_.createTimer(ros::Duration(1.0 / parameters_.marker_rate), &StiffnessNode::onMarkers, this)};
  // Not update(): it waits for ROS time, which may stand still or jump back.
  diagnostics_timer_ = node_.createWallTimer(ros::WallDuration(diagnostics_.getPeriod()),
                                             [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  ROS_INFO("%s, stepping %s, %d segment(s), %d chamber(s) on %d channel(s)", modelName(parameters_.model).c_str(),
           steppingName(parameters_.model.stepping).c_str(), parameters_.scene.segmentCount(),
           parameters_.scene.chamberCount(), pressure_input_.channelCount());
}

void StiffnessNode::onPressures(const Pressures& pressures, const ros::Time& stamp) {
  pressure_stamp_ = stamp;
  input_fault_.clear();
  registration_.addPressures(pressures, stamp);
  react(estimator_.setPressures(pressures));
}

void StiffnessNode::react(StiffnessEstimator::Outcome outcome) {
  if (!estimator_.status().ok()) pressure_input_.reject(estimator_.statusText());
  else if (outcome == StiffnessEstimator::Outcome::kSolved) estimate_stamp_ = pressure_stamp_;
  if (outcome != StiffnessEstimator::Outcome::kUnchanged) publishEstimate();
}

// The last good estimate, with the truth about how good it still is.
void StiffnessNode::publishEstimate() {
  if (estimator_.estimate() == nullptr) return;
  const Estimate& estimate = *estimator_.estimate();
  StiffnessEstimate message = toEstimate(estimate, estimate_stamp_, parameters_.frames.base);
  setStanding(estimator_.status().code, newestFault(), pressure_input_.isStale(), parameters_.pressure_timeout,
              "pressures", message);
  estimate_publisher_.publish(message);
  if (!message.stale) pose_output_.publish(estimate.solution.X_BT, estimate_stamp_);
}

void StiffnessNode::onHeartbeat(const ros::TimerEvent&) {
  pressure_input_.tend();
  tracker_input_.tend();
  wrench_input_.tend();
  if (isStale()) publishEstimate();
  else react(estimator_.solve());
}

void StiffnessNode::onTracked(const Pose& X_AS, const Pose& measured_X_BT, const ros::Time& stamp) {
  registration_.addPose(X_AS, estimator_.tipWrench(), contact_.inContact(), stamp);
  if (estimator_.estimate() == nullptr || isStale()) return;
  const Estimate& estimate = *estimator_.estimate();
  const Twist residual = residualTwist(measured_X_BT, estimate.solution.X_BT);
  const bool is_lost = tracker_input_.repeatsItself();
  contact_.update(estimator_.pressures(), estimate.tip_wrench, is_lost ? nullptr : &measured_X_BT, stamp);
  if (is_lost) return;
  tracking_error_ = linear(residual).norm();
  error_publisher_.publish(
      toTrackingError(measured_X_BT, estimate.solution.X_BT, residual, stamp, parameters_.frames.base));
}

void StiffnessNode::onMarkers(const ros::TimerEvent&) {
  if (estimator_.estimate() == nullptr) return;
  const Estimate& estimate = *estimator_.estimate();
  std::vector<Station> samples = estimator_.sampleBackbone(kBackboneSamples);
  if (samples.empty()) samples = estimate.stations;  // the newest solve failed: its shape is not to be shown
  if (samples.empty()) return;
  visualization_msgs::MarkerArray markers =
      makeMarkers(estimate, samples, tracker_input_.freshTip(), isStale(), marker_style_, estimate_stamp_);
  const auto add = [&](const visualization_msgs::MarkerArray& more) {
    markers.markers.insert(markers.markers.end(), more.markers.begin(), more.markers.end());
  };
  add(contact_.markers(marker_style_, estimate_stamp_));
  if (parameters_.show_eigenscrews)
    add(makeEigenscrewMarkers(estimate, isStale(), parameters_.eigenscrew_length, marker_style_, estimate_stamp_));
  marker_publisher_.publish(markers);
  if (tip_handle_) tip_handle_->update();
  backbone_publisher_.publish(toPath(samples, estimate.solution.X_BT, estimate_stamp_, parameters_.frames.base));
}

void StiffnessNode::diagnoseTracker(DiagnosticStatusWrapper& status) {
  tracker_input_.diagnose(status);
  status.add("tracking error (mm)", 1e3 * tracking_error_);
}

void StiffnessNode::diagnoseSolver(DiagnosticStatusWrapper& status) {
  status.add("model", modelName(parameters_.model) + ", " + steppingName(parameters_.model.stepping));
  reportSolver(estimator_, wrench_input_.fault(), status);
}

}  // namespace live_stiffness
