#pragma once
// A known external wrench on the body that the robot moves, from a topic, in the axes of the base or of the body.

#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "ros/conversions.h"
#include "ros/input_watch.h"

namespace live_stiffness {

class WrenchInput {
 public:
  using NewestPose = std::function<const Pose*()>;  // of the body in the base frame; nullptr: not known yet
  using OnWrench = std::function<void(const Wrench& wrench)>;

  // Calls on_wrench with [f; m] in base axes, and with zero after `timeout` s without a message; 0: never.
  WrenchInput(ros::NodeHandle node, const std::string& topic, FrameNames frames, double timeout,
              NewestPose newest_pose, OnWrench on_wrench);
  WrenchInput(const WrenchInput&) = delete;  // callbacks refer to it

  // Call now and then: lets the last wrench expire.
  void tend();
  // What was wrong with the newest message, with the name of the topic; empty: nothing.
  std::string fault() const;

 private:
  void onMessage(const geometry_msgs::WrenchStamped::ConstPtr& message);

  FrameNames frames_;
  double timeout_;
  NewestPose newest_pose_;
  OnWrench on_wrench_;
  InputWatch watch_;
  ros::Subscriber subscriber_;
};

}  // namespace live_stiffness
