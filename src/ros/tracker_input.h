#pragma once
// Measured tip pose from the tracker's topic or from tf, brought to the base frame by the registration.

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <optional>

#include "ros/any_type_subscriber.h"
#include "ros/conversions.h"
#include "ros/input_status.h"
#include "ros/node_parameters.h"

namespace live_stiffness {

// What a tracker measured.
struct TipMeasurement {
  Pose X_AS;  // of the sensor, as the tracker gives it
  Pose X_BT;  // of the tip, by the registration
  ros::Time stamp;
};

class TrackerInput {
 public:
  // Looks the sensor up in tf if ~aurora_tf_frame is set. parameters must outlive the input.
  TrackerInput(const ros::NodeHandle& node, const NodeParameters& parameters);

  // The measurement of a message; none if it cannot be used.
  std::optional<TipMeasurement> read(const AnyMessage& message);
  // The newest in tf; none if there is no new one, or it cannot be used.
  std::optional<TipMeasurement> lookUp();
  bool usesTf() const { return tf_listener_.has_value(); }

  // The newest measured pose of T in B, if it is not older than ~pose_timeout_s and the tracker has not lost its sensor.
  std::optional<Pose> freshTip() const;
  // True if the tracker gives the same pose for longer than ~pose_timeout_s: it has lost its sensor.
  bool repeatsItself() const { return unchangedFor() > parameters_.pose_timeout; }
  InputStatus& status() { return status_; }
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  double unchangedFor() const { return secondsBetween(last_change_, ros::Time::now()); }  // s
  std::optional<TipMeasurement> accept(const Parsed<TrackedPose>& parsed);
  // Why the pose cannot be used; empty: it can.
  std::string errorOf(const TrackedPose& tracked, const Pose& X_BT) const;

  const NodeParameters& parameters_;
  InputStatus status_;
  Pose X_AS_, X_BT_;        // newest
  ros::Time last_change_;   // when X_AS_ last changed
  ros::Time last_tf_stamp_;
  tf2_ros::Buffer tf_;
  std::optional<tf2_ros::TransformListener> tf_listener_;  // none: poses come on a topic
};

}  // namespace live_stiffness
