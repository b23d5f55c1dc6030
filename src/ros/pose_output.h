#pragma once
// The pose of the body that a robot moves, as a topic and in tf.

#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>

#include "ros/conversions.h"

namespace live_stiffness {

class PoseOutput {
 public:
  // Advertises ~topic (geometry_msgs/PoseStamped).
  PoseOutput(ros::NodeHandle private_node, const std::string& topic, FrameNames frames)
      : frames_(std::move(frames)), publisher_(private_node.advertise<geometry_msgs::PoseStamped>(topic, 10)) {}

  // X_BT: of the body in the base frame.
  void publish(const Pose& X_BT, const ros::Time& stamp) {
    publisher_.publish(toPoseStamped(X_BT, stamp, frames_.base));
    if (stamp == tf_stamp_) return;
    tf_stamp_ = stamp;
    broadcaster_.sendTransform(toTransform(X_BT, stamp, frames_.base, frames_.body));
  }

 private:
  FrameNames frames_;
  ros::Publisher publisher_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Time tf_stamp_;  // of the last transform sent; tf rejects a repeated stamp
};

}  // namespace live_stiffness
