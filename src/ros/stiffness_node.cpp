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
      contact_publisher_(private_node_.advertise<TipContact>("tip_contact", 10)),
      wrench_publisher_(private_node_.advertise<geometry_msgs::WrenchStamped>("tip_wrench_estimate", 10)),
      marker_publisher_(private_node_, parameters_.frames.base),
      updater_(parameters_, *this),
      pose_output_(private_node_, "tip_pose", parameters_.frames),
      comparison_(parameters_, *this),
      registration_(private_node_, model(), parameters_, [this](const Registration& registration) {
        const Lock lock(tracking_mutex_);
        parameters_.registration = registration;
        parameters_.is_registered = true;
        comparison_.reset();
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
           parameters_.scene.chamberCount(), updater_.pressures().channelCount());
  estimation_spinner_.start();
  tracking_spinner_.start();
}

StiffnessNode::~StiffnessNode() = default;

void StiffnessNode::subscribe(const ros::NodeHandle& node) {
  constexpr int kPressureQueue = 100;  // enough for a tenth of a second of 1 kHz
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
  if (!comparison_.tracker().usesTf())
    return pose_subscriber_.subscribe(tracking, "aurora_pose", 10, &StiffnessNode::onTrackerPose, this);
  for (const bool is_static : {true, false})
    subscribers_.push_back(tracking.subscribe<tf2_msgs::TFMessage>(
        is_static ? "/tf_static" : "/tf", 100,
        [this, is_static](const tf2_msgs::TFMessage::ConstPtr& message) { onTf(*message, is_static); }));
}

// The past for ~register is kept last, so that it does not delay the estimate.
void StiffnessNode::onPressures(const AnyMessage& message) {
  const Lock lock(estimation_mutex_);
  if (const auto used = updater_.onPressures(*message.getConstMessage(), message.getPublisherName()))
    registration_.addPressures(used->value, used->stamp);
}

void StiffnessNode::onChannelPressure(const sensor_msgs::FluidPressure& message, size_t channel) {
  const Lock lock(estimation_mutex_);
  if (const auto used = updater_.onChannelPressure(message, channel)) registration_.addPressures(used->value, used->stamp);
}

void StiffnessNode::onTipWrench(const geometry_msgs::WrenchStamped& message) {
  const Lock lock(estimation_mutex_);
  updater_.onTipWrench(message);
}

void StiffnessNode::onHeartbeat(const ros::WallTimerEvent&) {
  const Lock lock(estimation_mutex_);
  updater_.onHeartbeat();
}

void StiffnessNode::onEstimate(const StiffnessEstimate::ConstPtr& estimate, const Pose* X_BT) {
  estimate_publisher_.publish(estimate);  // shared: no copy for subscribers in this process
  frequency_.tick();
  if (X_BT == nullptr) return;
  time_stamps_.tick(estimate->header.stamp);
  pose_output_.publish(*X_BT, estimate->header.stamp);
}

EstimateSnapshot StiffnessNode::snapshot() {
  const Lock lock(estimation_mutex_);
  EstimateSnapshot snapshot{model(), nullptr, updater_.stamp(), updater_.isStale()};
  if (const Estimate* newest = updater_.estimator()->estimate()) snapshot.estimate = std::make_shared<Estimate>(*newest);
  return snapshot;
}

void StiffnessNode::onTrackerPose(const AnyMessage& message) {
  const Lock lock(tracking_mutex_);
  compare(comparison_.tracker().read(*message.getConstMessage()));
}

void StiffnessNode::onTf(const tf2_msgs::TFMessage& transforms, bool is_static) {
  const Lock lock(tracking_mutex_);
  compare(comparison_.tracker().read(transforms, is_static));
}

void StiffnessNode::onTrackingHeartbeat(const ros::WallTimerEvent&) {
  const Lock lock(tracking_mutex_);
  comparison_.tracker().status().checkClock();
}

void StiffnessNode::compare(const std::optional<Parsed<Pose>>& X_AS) {
  if (!X_AS) return;
  const double delay = parameters_.registration.tracker_delay;
  KnownState state;
  {
    const Lock lock(estimation_mutex_);
    state = updater_.stateAt(X_AS->stamp, delay);
  }
  registration_.addPose(X_AS->value, state.newest_wrench, comparison_.contact() != nullptr, X_AS->stamp.toSec() - delay);
  comparison_.compare(*X_AS, state);
}

void StiffnessNode::onContact(const TipContact& contact, const geometry_msgs::WrenchStamped& wrench) {
  wrench_publisher_.publish(wrench);
  contact_publisher_.publish(contact);
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
    measured_tip = comparison_.freshTip();
    if (const TipWrenchEstimate* touched = comparison_.contact())
      contact = makeContactMarkers(touched->X_BT.p, linear(touched->wrench), forceDeviation(*touched),
                                   parameters_.contact_arrow_scale, style, newest.stamp);
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
