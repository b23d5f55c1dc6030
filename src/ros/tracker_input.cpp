#include "ros/tracker_input.h"

#include <ros/console.h>
#include <tf2/exceptions.h>

#include "estimation/plausibility.h"

namespace live_stiffness {

using diagnostic_msgs::DiagnosticStatus;

TrackerInput::TrackerInput(const InputParameters& parameters, const Registration& registration)
    : parameters_(parameters), registration_(registration), status_("aurora_pose"), sensor_(parameters.sensor_frame) {}

std::optional<Parsed<Pose>> TrackerInput::read(const topic_tools::ShapeShifter& message) {
  return accept(readPose(message, metresPerUnit(parameters_.position_unit)));
}

std::optional<Parsed<Pose>> TrackerInput::read(const tf2_msgs::TFMessage& transforms, bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_tf_) tf_.clear(), last_tf_stamp_ = ros::Time();  // time jumped back
  last_tf_ = now;
  for (const geometry_msgs::TransformStamped& transform : transforms.transforms) try {
      tf_.setTransform(transform, "", is_static);
    } catch (const tf2::TransformException&) {  // of others; tf2 has logged it
    }
  try {
    geometry_msgs::TransformStamped transform =
        tf_.lookupTransform(parameters_.tracker_frame, parameters_.tracker_tf_frame, ros::Time(0));
    if (transform.header.stamp == last_tf_stamp_) return std::nullopt;
    last_tf_stamp_ = transform.header.stamp;
    transform.child_frame_id.clear();  // asked for by name
    return accept(readPose(transform, metresPerUnit(parameters_.position_unit)));
  } catch (const tf2::TransformException& error) {
    other_error_ = error.what();
    return std::nullopt;
  }
}

std::string TrackerInput::otherTool(const TrackedPose& tracked) {
  const auto must = [](const std::string& what) { return ": must be " + what; };
  const std::string& tracker = parameters_.tracker_frame;
  if (!tracked.frame.empty() && tracked.frame != tracker && tracked.frame != sensor_)
    return "unknown frame " + tracked.frame + must(tracker + (sensor_.empty() ? "" : " or " + sensor_)) +
           "; see tracker_frame and sensor_frame";
  if (sensor_.empty() && !tracked.child.empty()) {
    sensor_ = tracked.child;
    ROS_INFO("aurora_pose: the sensor on the tip is %s, the first one seen; see sensor_frame", sensor_.c_str());
  }
  if (!tracked.child.empty() && tracked.child != sensor_)
    return "sensor " + tracked.child + must(sensor_) + "; see sensor_frame";
  return "";
}

std::optional<Parsed<Pose>> TrackerInput::accept(const Parsed<TrackedPose>& parsed) {
  const Pose& X_AS = parsed.value.pose;
  std::string error = parsed.error;
  if (error.empty()) {
    other_error_ = otherTool(parsed.value);
    if (!other_error_.empty()) {
      const std::string& child = parsed.value.child;
      ++others_[child.empty() ? parsed.value.frame : child];
      return std::nullopt;
    }
    error = reachFault(X_AS.p.norm(), (registration_.X_AB.inverse() * X_AS).p.norm(), kInputRemedies);
  }
  if (!error.empty()) {
    other_error_.clear();
    status_.reject(error);
    return std::nullopt;
  }
  const bool had_message = status_.hasMessage();
  const std::optional<ros::Time> stamp = status_.accept(parsed.stamp);
  if (!stamp) return std::nullopt;
  is_repeated_ = had_message && X_AS.p == X_AS_.p && X_AS.R == X_AS_.R;
  if (!is_repeated_) {
    last_change_ = ros::Time::now();
    const bool was_known = finder_.found().has_value();
    finder_.add(X_AS);
    if (!was_known && finder_.found() && parameters_.tracker_measures.empty())
      ROS_WARN("aurora_pose: %s", report().back().c_str());
  }
  X_AS_ = X_AS;
  return Parsed<Pose>{*stamp, X_AS, ""};
}

std::optional<TrackerMeasures> TrackerInput::knownMeasures() const {
  if (!parameters_.tracker_measures.empty()) return trackerMeasuresNamed(parameters_.tracker_measures);
  return finder_.found();
}

TrackerMeasures TrackerInput::measures() const { return knownMeasures().value_or(TrackerMeasures::kPose); }

std::string TrackerInput::othersText() const {
  std::string text;
  for (const auto& [name, count] : others_)
    text += (text.empty() ? "" : ", ") + (name.empty() ? "(no name)" : name) + " (" + std::to_string(count) + " poses)";
  return text;
}

std::vector<std::string> TrackerInput::report() const {
  std::vector<std::string> lines = status_.report();
  if (!others_.empty()) lines.push_back(status_.name() + ": left out other tools: " + othersText());
  if (!other_error_.empty() && status_.accepted() == 0) lines.push_back(status_.name() + ": " + other_error_);
  if (parameters_.tracker_measures.empty() && finder_.found())
    lines.push_back("the tracker measures " + trackerMeasuresName(*finder_.found()) +
                    " only, by its data; set tracker_measures to say so, or pose if it does not");
  return lines;
}

void TrackerInput::diagnose(const std::string& doubt, diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (!other_error_.empty() && !isFresh())
    status.summary(DiagnosticStatus::WARN, other_error_);
  else if (!status_.error().empty())
    status.summary(DiagnosticStatus::WARN, status_.error());
  else if (!status_.hasMessage())
    status.summary(DiagnosticStatus::WARN, "no tracker pose received yet; estimates do not need it");
  else if (status_.age() > parameters_.pose_timeout)
    status.summaryf(DiagnosticStatus::WARN, "tracker pose is stale: %.1f s old", status_.age());
  else if (repeatsItself())
    status.summaryf(DiagnosticStatus::WARN, "tracker repeats the same pose for %.1f s: sensor lost?", unchangedFor());
  else if (!status_.warning().empty())
    status.summary(DiagnosticStatus::WARN, status_.warning());
  else if (!doubt.empty())
    status.summary(DiagnosticStatus::WARN, doubt);
  else
    status.summary(DiagnosticStatus::OK, "ok");
  status_.addCounts(status);
  status.add("measures", trackerMeasuresName(measures()));
  if (!others_.empty()) status.add("other tools", othersText());
}

}  // namespace live_stiffness
