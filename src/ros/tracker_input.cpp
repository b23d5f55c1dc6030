#include "ros/tracker_input.h"

#include <ros/master.h>

#include <algorithm>

#include "ros/any_subscriber.h"

namespace live_stiffness {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kTfPollRate = 40.0;     // Hz, an NDI Aurora's
constexpr double kPlausibleReach = 5.0;  // m from tracker and base; a position beyond is in millimetres

}  // namespace

TrackerInput::TrackerInput(const ros::NodeHandle& node, const NodeParameters& parameters, OnTip on_tip)
    : node_(node), parameters_(parameters), on_tip_(std::move(on_tip)), watch_("aurora_pose") {
  if (parameters_.tracker_tf_frame.empty()) {
    subscribe();
  } else {
    tf_listener_ = std::make_unique<tf2_ros::TransformListener>(tf_buffer_, node);
    tf_timer_ = node.createTimer(ros::Duration(1.0 / kTfPollRate), &TrackerInput::onTfPoll, this);
  }
}

void TrackerInput::tend() {
  watch_.notice(ros::Time::now());
  if (!parameters_.tracker_tf_frame.empty() || freshTip() || subscriber_.getNumPublishers() > 0) return;
  if (!watch_.mayRetry() || !ros::master::check()) return;  // without a master it would wait for one
  subscriber_.shutdown();  // first, else the new one shares its connections and with them the type
  subscribe();
}

void TrackerInput::subscribe() {
  const auto on_any = [this](const auto& message, const std::string&) {
    take(readPose(message, parameters_.position_unit));
  };
  subscriber_ = subscribeAny<geometry_msgs::PoseStamped>(node_, "aurora_pose", 10, on_any, on_any);
}

void TrackerInput::onTfPoll(const ros::TimerEvent&) {
  try {
    const geometry_msgs::TransformStamped transform =
        tf_buffer_.lookupTransform(parameters_.tracker_frame, parameters_.tracker_tf_frame, ros::Time(0));
    if (transform.header.stamp == last_tf_stamp_) return;
    last_tf_stamp_ = transform.header.stamp;
    take(readPose(transform, parameters_.position_unit));
  } catch (const tf2::TransformException& error) {
    watch_.reject(error.what());
  }
}

void TrackerInput::take(const Reading<TrackedPose>& reading) {
  if (!reading.ok()) return watch_.reject(reading.fault);
  const std::string& frame = reading.value.frame;
  if (!frame.empty() && frame != parameters_.tracker_frame && frame != parameters_.sensor_frame)
    return watch_.reject("unknown frame " + frame + ": must be " + parameters_.tracker_frame + " or " +
                         parameters_.sensor_frame + "; see ~tracker_frame");
  const Pose& X_AS = reading.value.pose;
  const Pose X_BT = parameters_.registration.tipPose(X_AS);
  if (std::min(X_AS.p.norm(), X_BT.p.norm()) > kPlausibleReach)
    return watch_.reject("position is " + numberText(X_AS.p.norm()) + " m away: must be within " +
                         numberText(kPlausibleReach) +
                         " m of tracker or base; millimetres? (set ~aurora_position_unit: mm)");
  const ros::Time now = ros::Time::now();
  watch_.notice(now);
  if (!watch_.arrivesInOrder(reading.stamp)) return;
  if (!watch_.everAccepted() || X_AS.p != X_AS_.p || X_AS.R != X_AS_.R) last_change_ = now;
  X_AS_ = X_AS;
  X_BT_ = X_BT;
  const ros::Time stamp = watch_.stampFor(reading.stamp, now);
  watch_.accept(now, stamp);
  on_tip_(X_AS, X_BT_, stamp);
}

std::optional<Pose> TrackerInput::freshTip() const {
  if (watch_.age(ros::Time::now()) > parameters_.pose_timeout || repeatsItself()) return std::nullopt;
  return X_BT_;
}

void TrackerInput::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const ros::Time now = ros::Time::now();
  if (!watch_.currentFault().empty())
    status.summary(DiagnosticStatus::WARN, watch_.currentFault());
  else if (!watch_.everAccepted())
    status.summary(DiagnosticStatus::WARN, "no tracker pose received yet; estimates do not need it");
  else if (watch_.age(now) > parameters_.pose_timeout)
    status.summaryf(DiagnosticStatus::WARN, "tracker pose is stale: %.1f s old", watch_.age(now));
  else if (repeatsItself())
    status.summaryf(DiagnosticStatus::WARN, "tracker repeats the same pose for %.1f s: sensor lost?", unchangedFor());
  else if (!watch_.oddity().empty())
    status.summary(DiagnosticStatus::WARN, watch_.oddity());
  else
    status.summary(DiagnosticStatus::OK, "ok");
  watch_.report(status);
}

}  // namespace live_stiffness
