#pragma once
// Measured tip pose from the tracker's topic or from tf, brought to the base frame by the registration.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <functional>
#include <memory>
#include <optional>

#include "ros/conversions.h"
#include "ros/input_watch.h"
#include "ros/node_parameters.h"

namespace live_stiffness {

class TrackerInput {
 public:
  // X_AS: of the sensor, as the tracker gives it; measured_X_BT: of the tip, by the registration.
  using OnTip = std::function<void(const Pose& X_AS, const Pose& measured_X_BT, const ros::Time& stamp)>;

  // Calls on_tip with each usable measurement. parameters must outlive the input.
  TrackerInput(const ros::NodeHandle& node, const NodeParameters& parameters, OnTip on_tip);

  // The newest measured pose of T in B, if it is not older than pose_timeout and the tracker has not lost its sensor.
  std::optional<Pose> freshTip() const;
  // True if the tracker has said the same for longer than pose_timeout: it has lost its sensor.
  bool repeatsItself() const { return unchangedFor() > parameters_.pose_timeout; }
  // Call now and then: a subscriber keeps the type of its first publisher, so it is renewed when that one is gone.
  void tend();
  // That looks up poses given by tf; empty if they come on a topic.
  const ros::Timer& tfTimer() const { return tf_timer_; }
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  void subscribe();
  void onTfPoll(const ros::TimerEvent&);
  double unchangedFor() const { return (ros::Time::now() - last_change_).toSec(); }  // s
  void take(const Reading<TrackedPose>& reading);

  ros::NodeHandle node_;
  const NodeParameters& parameters_;
  OnTip on_tip_;
  InputWatch watch_;
  Pose X_AS_, X_BT_;
  ros::Time last_change_;  // when X_AS last changed: a tracker that repeats itself has lost its sensor
  ros::Time last_tf_stamp_;
  ros::Subscriber subscriber_;
  ros::Timer tf_timer_;
  tf2_ros::Buffer tf_buffer_;
  std::unique_ptr<tf2_ros::TransformListener> tf_listener_;
};

}  // namespace live_stiffness
