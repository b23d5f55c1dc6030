#include "ros/tracker_input.h"

#include <algorithm>

namespace live_stiffness {

using diagnostic_msgs::DiagnosticStatus;

TrackerInput::TrackerInput(const ros::NodeHandle& node, const NodeParameters& parameters)
    : parameters_(parameters), status_("aurora_pose") {
  if (!parameters_.tracker_tf_frame.empty()) tf_listener_.emplace(tf_, node);
}

std::optional<TipMeasurement> TrackerInput::read(const AnyMessage& message) {
  return accept(readPose(*message.getConstMessage(), metresPerUnit(parameters_.position_unit)));
}

std::optional<TipMeasurement> TrackerInput::lookUp() {
  try {
    const geometry_msgs::TransformStamped transform =
        tf_.lookupTransform(parameters_.tracker_frame, parameters_.tracker_tf_frame, ros::Time(0));
    if (transform.header.stamp == last_tf_stamp_) return std::nullopt;
    last_tf_stamp_ = transform.header.stamp;
    return accept(readPose(transform, metresPerUnit(parameters_.position_unit)));
  } catch (const tf2::TransformException& error) {
    status_.reject(error.what());
    return std::nullopt;
  }
}

std::string TrackerInput::errorOf(const TrackedPose& tracked, const Pose& X_BT) const {
  constexpr double kPlausibleReach = 5.0;  // m from tracker and base; positions farther away are in millimetres
  const std::string& frame = tracked.frame;
  if (!frame.empty() && frame != parameters_.tracker_frame && frame != parameters_.sensor_frame)
    return "unknown frame " + frame + ": must be " + parameters_.tracker_frame + " or " + parameters_.sensor_frame +
           "; see ~tracker_frame";
  const double distance = tracked.pose.p.norm();
  if (std::min(distance, X_BT.p.norm()) > kPlausibleReach)
    return "position is " + numberText(distance) + " m away: must be within " + numberText(kPlausibleReach) +
           " m of tracker or base; millimetres? (set ~aurora_position_unit: mm)";
  return "";
}

std::optional<TipMeasurement> TrackerInput::accept(const Parsed<TrackedPose>& parsed) {
  const Pose& X_AS = parsed.value.pose;
  const Pose X_BT = parameters_.registration.tipPose(X_AS);
  const std::string error = parsed.ok() ? errorOf(parsed.value, X_BT) : parsed.error;
  if (!error.empty()) {
    status_.reject(error);
    return std::nullopt;
  }
  const bool had_message = status_.hasMessage();
  const std::optional<ros::Time> stamp = status_.accept(parsed.stamp);
  if (!stamp) return std::nullopt;
  if (!had_message || X_AS.p != X_AS_.p || X_AS.R != X_AS_.R) last_change_ = ros::Time::now();
  X_AS_ = X_AS;
  X_BT_ = X_BT;
  return TipMeasurement{X_AS, X_BT, *stamp};
}

std::optional<Pose> TrackerInput::freshTip() const {
  if (status_.age() > parameters_.pose_timeout || repeatsItself()) return std::nullopt;
  return X_BT_;
}

void TrackerInput::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (!status_.error().empty())
    status.summary(DiagnosticStatus::WARN, status_.error());
  else if (!status_.hasMessage())
    status.summary(DiagnosticStatus::WARN, "no tracker pose received yet; estimates do not need it");
  else if (status_.age() > parameters_.pose_timeout)
    status.summaryf(DiagnosticStatus::WARN, "tracker pose is stale: %.1f s old", status_.age());
  else if (repeatsItself())
    status.summaryf(DiagnosticStatus::WARN, "tracker repeats the same pose for %.1f s: sensor lost?", unchangedFor());
  else if (!status_.warning().empty())
    status.summary(DiagnosticStatus::WARN, status_.warning());
  else
    status.summary(DiagnosticStatus::OK, "ok");
  status_.addCounts(status);
}

}  // namespace live_stiffness
