#include "ros/stiffness_node.h"

#include "live_stiffness/analysis/deflection.h"
#include "ros/solver_report.h"

namespace live_stiffness {
namespace {

constexpr int kBackboneSamples = 20;     // per segment
constexpr double kOldestStamp = 1.0;     // s, of pressures when their estimate is published
constexpr double kFuturestStamp = 0.1;   // s

ros::NodeHandle onGlobalQueue(ros::NodeHandle node) {
  node.setCallbackQueue(nullptr);
  return node;
}

void append(visualization_msgs::MarkerArray& all, const visualization_msgs::MarkerArray& more) {
  all.markers.insert(all.markers.end(), more.markers.begin(), more.markers.end());
}

}  // namespace

StiffnessNode::StiffnessNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : parameters_(loadNodeParameters(private_node)),
      node_(onGlobalQueue(node)),
      private_node_(onGlobalQueue(private_node)),
      estimator_(std::make_shared<StiffnessEstimator>(parameters_.scene, parameters_.model, parameters_.estimator)),
      pose_output_(private_node_, "tip_pose", parameters_.frames),
      contact_(private_node_, parameters_),
      diagnostics_(node_, private_node_),
      lowest_rate_(parameters_.heartbeat),
      frequency_({&lowest_rate_, &highest_rate_}, "Estimates"),
      time_stamps_({-kFuturestStamp, kOldestStamp}, "Time stamps"),
      wrench_input_(
          live_.handle(node), "tip_wrench", parameters_.frames, parameters_.tip_wrench_timeout,
          [this] { return estimator_->estimate() ? &estimator_->estimate()->solution.X_BT : nullptr; },
          [this](const Wrench& wrench) { react(estimator_->setTipWrench(wrench)); }),
      pressure_input_(
          live_.handle(node), parameters_,
          [this](const Pressures& pressures, const ros::Time& stamp) { onPressures(pressures, stamp); },
          [this](const std::string& fault) { input_fault_ = fault; }),
      tracker_input_(tracking_.handle(node), parameters_,
                     [this](const Pose& X_AS, const Pose& measured_X_BT, const ros::Time& stamp) {
                       onTracked(X_AS, measured_X_BT, stamp);
                     }),
      services_(private_node_, parameters_.frames, [this] { return newest(); }),
      registration_(private_node_, model(), parameters_, [this](const Registration& registration) {
        const Lock lock(tracking_.mutex());
        parameters_.registration = registration;
        contact_.reset();
      }) {
  estimate_publisher_ = private_node_.advertise<StiffnessEstimate>("estimate", 100);
  error_publisher_ = private_node_.advertise<TrackingError>("tracking_error", 10);
  backbone_publisher_ = private_node_.advertise<nav_msgs::Path>("backbone", 1);
  marker_publisher_ = private_node_.advertise<visualization_msgs::MarkerArray>("markers", 1);
  addDiagnostics();
  if (parameters_.tip_handle.enabled)
    tip_handle_ = std::make_unique<TipHandle>(private_node_, parameters_.style, parameters_.tip_handle,
                                              marker_publisher_, [this] { return newest(); });
  addServices();
  const ros::Duration heartbeat(1.0 / parameters_.heartbeat), between_markers(1.0 / parameters_.marker_rate);
  timers_ = {live_.handle(node).createTimer(heartbeat, &StiffnessNode::onHeartbeat, this),
             tracking_.handle(node).createTimer(heartbeat, [this](const ros::TimerEvent&) { tracker_input_.tend(); }),
             drawing_.handle(node).createTimer(between_markers, &StiffnessNode::onMarkers, this), tracker_input_.tfTimer()};
  const std::string fault = parameters_.lock_memory ? lockMemory() : "";
  if (!fault.empty()) ROS_WARN("~lock_memory: memory cannot be locked, going on without: %s", fault.c_str());
  ROS_INFO("%s, stepping %s, %d segment(s), %d chamber(s) on %d channel(s)", modelName(parameters_.model).c_str(),
           steppingName(parameters_.model.stepping).c_str(), parameters_.scene.segmentCount(),
           parameters_.scene.chamberCount(), pressure_input_.channelCount());
  live_.start("live_estimate", parameters_.realtime_priority);
  tracking_.start("live_tracking", 0);
  drawing_.start("live_drawing", 0);
}

StiffnessNode::~StiffnessNode() {
  drawing_.stop();
  tracking_.stop();
  live_.stop();
}

void StiffnessNode::onPressures(const Pressures& pressures, const ros::Time& stamp) {
  pressure_stamp_ = stamp;
  input_fault_.clear();
  if (!is_paused_) {
    react(estimator_->setPressures(pressures, stamp.toSec()));
    if (estimator_->estimate() != nullptr && estimator_->status().ok())
      history_.add({stamp.toSec(), pressures, estimator_->estimate()->solution.X_BT});
  }
  registration_.addPressures(pressures, stamp);  // last, so that the estimate does not wait for it
}

void StiffnessNode::react(StiffnessEstimator::Outcome outcome) {
  if (!estimator_->status().ok()) pressure_input_.reject(estimator_->statusText());
  else if (outcome == StiffnessEstimator::Outcome::kSolved) estimate_stamp_ = pressure_stamp_;
  if (outcome != StiffnessEstimator::Outcome::kUnchanged) publishEstimate();
}

std::string StiffnessNode::newestFault() const {
  if (is_paused_) return "paused: ~pause with false goes on";
  return input_fault_.empty() ? estimator_->statusText() : input_fault_;
}

// The last good estimate, with the truth about how good it still is.
void StiffnessNode::publishEstimate() {
  if (estimator_->estimate() == nullptr) return;
  const Estimate& estimate = *estimator_->estimate();
  const auto message =
      boost::make_shared<StiffnessEstimate>(toEstimate(estimate, estimate_stamp_, parameters_.frames.base));
  setStanding(estimator_->status().code, newestFault(), pressure_input_.isStale(), parameters_.pressure_timeout,
              "pressures", *message);
  if (is_paused_) message->status = static_cast<uint8_t>(estimator_->status().code);
  estimate_publisher_.publish(message);  // shared: no copy for subscribers in this process
  frequency_.tick();
  if (message->stale) return;
  time_stamps_.tick(estimate_stamp_);
  pose_output_.publish(estimate.solution.X_BT, estimate_stamp_);
}

void StiffnessNode::onHeartbeat(const ros::TimerEvent&) {
  pressure_input_.tend();
  wrench_input_.tend();
  if (isStale()) publishEstimate();
  else react(estimator_->solve());
}

NewestEstimate StiffnessNode::newestOfLane() const {
  NewestEstimate newest{model(), nullptr, estimate_stamp_, isStale()};
  if (estimator_->estimate() != nullptr) newest.estimate = std::make_shared<Estimate>(*estimator_->estimate());
  return newest;
}

NewestEstimate StiffnessNode::newest() {
  const Lock lock(live_.mutex());
  return newestOfLane();
}

void StiffnessNode::onTracked(const Pose& X_AS, const Pose& measured_X_BT, const ros::Time& stamp) {
  // A late tracker shows how the robot stood then.
  const double delay = parameters_.registration.tracker_delay, time = stamp.toSec() - delay;
  Moment then;
  Wrench newest_wrench, solved_wrench;
  bool is_known;
  {
    const Lock lock(live_.mutex());
    const Estimate* estimate = estimator_->estimate();
    newest_wrench = estimator_->tipWrench();
    is_known = estimate != nullptr && !isStale() && !history_.empty();
    if (is_known) {
      solved_wrench = estimate->tip_wrench;
      then = delay == 0.0 ? Moment{time, estimator_->pressures(), estimate->solution.X_BT} : history_.at(time);
    }
  }
  registration_.addPose(X_AS, newest_wrench, contact_.inContact(), time);
  if (!is_known) return;
  const Twist residual = residualTwist(measured_X_BT, then.X_BT);
  const bool is_lost = tracker_input_.repeatsItself();
  contact_.update(then.pressures, solved_wrench, is_lost ? nullptr : &measured_X_BT, stamp);
  if (is_lost) return;
  tracking_error_ = linear(residual).norm();
  error_publisher_.publish(toTrackingError(measured_X_BT, then.X_BT, residual, stamp, parameters_.frames.base));
}

// Solved anew, so that the live lane need not wait while it is sampled.
std::vector<Station> StiffnessNode::shapeOf(const NewestEstimate& newest) {
  const Estimate& estimate = *newest.estimate;
  shape_solver_.follow(newest.model);
  const StiffnessSolution solution =
      shape_solver_.model().solve(estimate.effective, estimate.tip_wrench, shape_solver_.workspace());
  if (solution.status.ok() && isSameEquilibrium(solution.X_BT, estimate.solution.X_BT, shape_solver_.model()))
    return sampleBackbone(shape_solver_.model(), shape_solver_.workspace(), kBackboneSamples);
  // In another stable shape than the one it takes from rest, which only the live solver can show.
  const Lock lock(live_.mutex());
  const std::vector<Station> samples = estimator_->sampleBackbone(kBackboneSamples);
  return samples.empty() ? estimate.stations : samples;
}

void StiffnessNode::onMarkers(const ros::TimerEvent&) {
  const NewestEstimate newest = this->newest();
  if (newest.estimate == nullptr) return;
  const Estimate& estimate = *newest.estimate;
  const std::vector<Station> samples = shapeOf(newest);
  if (samples.empty()) return;
  std::optional<Pose> measured_tip;
  visualization_msgs::MarkerArray contact;
  MarkerStyle style;
  double eigenscrew_length;  // m; 0: none are shown
  {
    const Lock lock(tracking_.mutex());
    style = parameters_.style;
    eigenscrew_length = parameters_.show_eigenscrews ? parameters_.eigenscrew_length : 0.0;
    measured_tip = tracker_input_.freshTip();
    contact = contact_.markers(style, newest.stamp);
  }
  visualization_msgs::MarkerArray markers =
      makeMarkers(estimate, samples, measured_tip, newest.stale, style, newest.stamp);
  append(markers, contact);
  if (eigenscrew_length > 0.0)
    append(markers, makeEigenscrewMarkers(estimate, newest.stale, eigenscrew_length, style, newest.stamp));
  marker_publisher_.publish(markers);
  if (tip_handle_) tip_handle_->update();
  backbone_publisher_.publish(toPath(samples, estimate.solution.X_BT, newest.stamp, style.frame));
}

void StiffnessNode::addDiagnostics() {
  diagnostics_.setHardwareID("live_stiffness");
  diagnostics_.add("Pressures", [this](Status& status) {
    const Lock lock(live_.mutex());
    pressure_input_.diagnose(status);
  });
  diagnostics_.add("Tracker", [this](Status& status) {
    const Lock lock(tracking_.mutex());
    tracker_input_.diagnose(status);
    status.add("tracking error (mm)", 1e3 * tracking_error_);
  });
  diagnostics_.add("Contact", [this](Status& status) {
    const Lock lock(tracking_.mutex());
    contact_.diagnose(status);
  });
  diagnostics_.add("Solver", [this](Status& status) {
    const Lock lock(live_.mutex());
    status.add("model", modelName(parameters_.model) + ", " + steppingName(parameters_.model.stepping));
    reportSolver(*estimator_, wrench_input_.fault(), status);
    if (is_paused_) status.summary(diagnostic_msgs::DiagnosticStatus::WARN, newestFault());
  });
  diagnostics_.add("Clock", &clock_watch_, &ClockWatch::diagnose);
  diagnostics_.add(frequency_);
  diagnostics_.add(time_stamps_);
  // Not update(): it waits for ROS time, which may stand still or jump back.
  diagnostics_timer_ = node_.createWallTimer(ros::WallDuration(diagnostics_.getPeriod()),
                                             [this](const ros::WallTimerEvent&) {
                                               diagnostics_.force_update();
                                               clock_watch_.restartAfterJump(timers_);
                                             });
}

}  // namespace live_stiffness
