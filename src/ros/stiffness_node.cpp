#include "ros/stiffness_node.h"

#include "live_stiffness/analysis/deflection.h"
#include "ros/markers.h"
#include "ros/tip_handle.h"

namespace live_stiffness {
namespace {

// The same names, with callbacks in a queue; nullptr: the global one.
ros::NodeHandle onQueue(ros::NodeHandle node, ros::CallbackQueue* queue) {
  node.setCallbackQueue(queue);
  return node;
}

void append(visualization_msgs::MarkerArray& all, const visualization_msgs::MarkerArray& more) {
  all.markers.insert(all.markers.end(), more.markers.begin(), more.markers.end());
}

}  // namespace

StiffnessNode::StiffnessNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : parameters_(loadNodeParameters(private_node)),
      node_(onQueue(node, nullptr)),
      private_node_(onQueue(private_node, nullptr)),
      estimate_publisher_(private_node_.advertise<StiffnessEstimate>("estimate", 100)),
      backbone_publisher_(private_node_.advertise<nav_msgs::Path>("backbone", 1)),
      error_publisher_(private_node_.advertise<TrackingError>("tracking_error", 10)),
      marker_publisher_(private_node_, parameters_.frames.base),
      estimator_(std::make_shared<StiffnessEstimator>(parameters_.scene, parameters_.model, parameters_.estimator)),
      pressure_input_(parameters_),
      wrench_input_("tip_wrench", parameters_.frames, parameters_.tip_wrench_timeout),
      pose_output_(private_node_, "tip_pose", parameters_.frames),
      tracker_input_(onQueue(node, &tracking_queue_), parameters_),
      contact_(private_node_, parameters_),
      registration_(private_node_, model(), parameters_, [this](const Registration& registration) {
        const Lock lock(tracking_mutex_);
        parameters_.registration = registration;
        parameters_.is_registered = true;
        contact_.reset();
      }),
      diagnostics_(node_, private_node_) {
  if (parameters_.tip_handle.enabled)
    tip_handle_ = std::make_unique<TipHandle>(private_node_, parameters_.style, parameters_.tip_handle,
                                              [this] { return snapshot(); });
  addDiagnostics();
  addServices();
  subscribe(node);
  ROS_INFO("%s, stepping %s, %d segment(s), %d chamber(s) on %d channel(s)", modelName(parameters_.model).c_str(),
           steppingName(parameters_.model.stepping).c_str(), parameters_.scene.segmentCount(),
           parameters_.scene.chamberCount(), pressure_input_.channelCount());
  estimation_spinner_.start();
  tracking_spinner_.start();
}

StiffnessNode::~StiffnessNode() = default;

void StiffnessNode::subscribe(const ros::NodeHandle& node) {
  constexpr int kPressureQueue = 100;  // enough for a tenth of a second of 1 kHz
  constexpr double kTfRate = 40.0;     // Hz, an NDI Aurora's
  ros::NodeHandle estimation = onQueue(node, &estimation_queue_), tracking = onQueue(node, &tracking_queue_);
  const std::vector<std::string>& topics = parameters_.pressure_topics;
  for (size_t channel = 0; channel < topics.size(); ++channel)
    subscribers_.push_back(estimation.subscribe<sensor_msgs::FluidPressure>(
        topics[channel], 10, [this, channel](const sensor_msgs::FluidPressure::ConstPtr& message) {
          onChannelPressure(*message, channel);
        }));
  if (topics.empty())
    pressure_subscriber_.subscribe(estimation, "chamber_pressures", kPressureQueue, &StiffnessNode::onPressures, this);
  subscribers_.push_back(estimation.subscribe("tip_wrench", 10, &StiffnessNode::onTipWrench, this));
  // Wall time: simulated time may stand still or jump back.
  const ros::WallDuration heartbeat(1.0 / parameters_.heartbeat);
  timers_ = {estimation.createWallTimer(heartbeat, &StiffnessNode::onHeartbeat, this),
             tracking.createWallTimer(heartbeat, &StiffnessNode::onTrackingHeartbeat, this),
             node_.createWallTimer(ros::WallDuration(1.0 / parameters_.marker_rate), &StiffnessNode::onMarkers, this)};
  if (tracker_input_.usesTf())
    timers_.push_back(tracking.createWallTimer(ros::WallDuration(1.0 / kTfRate), &StiffnessNode::onTfTimer, this));
  else
    pose_subscriber_.subscribe(tracking, "aurora_pose", 10, &StiffnessNode::onTrackerPose, this);
}

void StiffnessNode::onPressures(const AnyMessage& message) {
  const Lock lock(estimation_mutex_);
  if (const auto pressures = pressure_input_.read(message)) estimate(*pressures);
}

void StiffnessNode::onChannelPressure(const sensor_msgs::FluidPressure& message, size_t channel) {
  const Lock lock(estimation_mutex_);
  if (const auto pressures = pressure_input_.readChannel(message, channel)) estimate(*pressures);
}

void StiffnessNode::onTipWrench(const geometry_msgs::WrenchStamped& message) {
  const Lock lock(estimation_mutex_);
  const Pose* const X_BT = estimator_->estimate() ? &estimator_->estimate()->solution.X_BT : nullptr;
  if (const auto wrench = wrench_input_.read(message, X_BT)) onSolved(estimator_->setTipWrench(*wrench));
}

void StiffnessNode::onHeartbeat(const ros::WallTimerEvent&) {
  const Lock lock(estimation_mutex_);
  pressure_input_.status().checkClock();
  if (wrench_input_.expires()) onSolved(estimator_->setTipWrench(Wrench::Zero()));
  if (isStale()) publishEstimate();
  else onSolved(estimator_->solve());
}

void StiffnessNode::estimate(const Parsed<Pressures>& pressures) {
  pressure_stamp_ = pressures.stamp;
  if (!is_paused_) {
    const double time = pressures.stamp.toSec();
    onSolved(estimator_->setPressures(pressures.value, time));
    if (estimator_->estimate() != nullptr && estimator_->status().ok())
      history_.add({time, pressures.value, estimator_->estimate()->solution.X_BT});
  }
  registration_.addPressures(pressures.value, pressures.stamp);  // last, so that it does not delay the estimate
}

void StiffnessNode::onSolved(StiffnessEstimator::Outcome outcome) {
  if (!estimator_->status().ok()) pressure_input_.status().logError(estimator_->statusText());
  else if (outcome == StiffnessEstimator::Outcome::kSolved) estimate_stamp_ = pressure_stamp_;
  if (outcome != StiffnessEstimator::Outcome::kUnchanged) publishEstimate();
}

std::string StiffnessNode::newestError() const {
  if (is_paused_) return "paused: call ~pause with false to continue";
  const std::string& input_error = pressure_input_.status().error();
  return input_error.empty() ? estimator_->statusText() : input_error;
}

// The last good estimate, with its present status.
void StiffnessNode::publishEstimate() {
  if (estimator_->estimate() == nullptr) return;
  const Estimate& estimate = *estimator_->estimate();
  const auto message =
      boost::make_shared<StiffnessEstimate>(toEstimate(estimate, estimate_stamp_, parameters_.frames.base));
  setStatus(estimator_->status().code, newestError(), pressure_input_.status().isStale(), parameters_.pressure_timeout,
            "pressures", *message);
  if (is_paused_) message->status = static_cast<uint8_t>(estimator_->status().code);
  estimate_publisher_.publish(message);  // shared: no copy for subscribers in this process
  frequency_.tick();
  if (message->stale) return;
  time_stamps_.tick(estimate_stamp_);
  pose_output_.publish(estimate.solution.X_BT, estimate_stamp_);
}

EstimateSnapshot StiffnessNode::snapshot() {
  const Lock lock(estimation_mutex_);
  EstimateSnapshot snapshot{model(), nullptr, estimate_stamp_, isStale()};
  if (estimator_->estimate() != nullptr) snapshot.estimate = std::make_shared<Estimate>(*estimator_->estimate());
  return snapshot;
}

void StiffnessNode::onTrackerPose(const AnyMessage& message) {
  const Lock lock(tracking_mutex_);
  if (const auto measured = tracker_input_.read(message)) compare(*measured);
}

void StiffnessNode::onTfTimer(const ros::WallTimerEvent&) {
  const Lock lock(tracking_mutex_);
  if (const auto measured = tracker_input_.lookUp()) compare(*measured);
}

void StiffnessNode::onTrackingHeartbeat(const ros::WallTimerEvent&) {
  const Lock lock(tracking_mutex_);
  tracker_input_.status().checkClock();
}

void StiffnessNode::compare(const TipMeasurement& measured) {
  // A late tracker shows where the robot was then.
  const double delay = parameters_.registration.tracker_delay, time = measured.stamp.toSec() - delay;
  Moment then;
  Wrench newest_wrench, solved_wrench;
  bool is_known;
  {
    const Lock lock(estimation_mutex_);
    const Estimate* const estimate = estimator_->estimate();
    newest_wrench = estimator_->tipWrench();
    is_known = estimate != nullptr && !isStale() && !history_.empty();
    if (is_known) {
      solved_wrench = estimate->tip_wrench;
      then = delay == 0.0 ? Moment{time, estimator_->pressures(), estimate->solution.X_BT} : history_.at(time);
    }
  }
  registration_.addPose(measured.X_AS, newest_wrench, contact_.inContact(), time);
  if (!is_known) return;
  const Twist residual = residualTwist(measured.X_BT, then.X_BT);
  const bool is_lost = tracker_input_.repeatsItself();
  contact_.update(then.pressures, solved_wrench, is_lost ? nullptr : &measured.X_BT, measured.stamp);
  if (is_lost) return;
  tracking_error_ = linear(residual).norm();
  error_publisher_.publish(
      toTrackingError(measured.X_BT, then.X_BT, residual, measured.stamp, parameters_.frames.base));
}

void StiffnessNode::onMarkers(const ros::WallTimerEvent&) {
  const EstimateSnapshot newest = snapshot();
  if (newest.estimate == nullptr) return marker_publisher_.publish({});
  const Estimate& estimate = *newest.estimate;
  const MarkerStyle& style = parameters_.style;
  std::optional<Pose> measured_tip;
  visualization_msgs::MarkerArray contact;
  {
    const Lock lock(tracking_mutex_);
    measured_tip = tracker_input_.freshTip();
    contact = contact_.markers(style, newest.stamp);
  }
  visualization_msgs::MarkerArray markers = makeMarkers(estimate, measured_tip, newest.stale, style, newest.stamp);
  append(markers, contact);
  if (parameters_.show_eigenscrews)
    append(markers,
           makeEigenscrewMarkers(estimate, newest.stale, parameters_.eigenscrew_length, style, newest.stamp));
  if (tip_handle_) append(markers, tip_handle_->update());
  marker_publisher_.publish(std::move(markers));
  backbone_publisher_.publish(toPath(estimate.shape, estimate.solution.X_BT, newest.stamp, style.frame));
}

}  // namespace live_stiffness
