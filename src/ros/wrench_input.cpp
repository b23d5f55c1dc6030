#include "ros/wrench_input.h"

namespace live_stiffness {

WrenchInput::WrenchInput(ros::NodeHandle node, const std::string& topic, FrameNames frames, double timeout,
                         NewestPose newest_pose, OnWrench on_wrench)
    : frames_(std::move(frames)),
      timeout_(timeout),
      newest_pose_(std::move(newest_pose)),
      on_wrench_(std::move(on_wrench)),
      watch_(topic),
      subscriber_(node.subscribe(topic, 10, &WrenchInput::onMessage, this)) {}

void WrenchInput::onMessage(const geometry_msgs::WrenchStamped::ConstPtr& message) {
  const Reading<Wrench> reading = readWrench(*message, frames_, newest_pose_());
  if (!reading.ok()) return watch_.reject(reading.fault);
  watch_.accept(ros::Time::now());
  on_wrench_(reading.value);
}

void WrenchInput::tend() {
  if (timeout_ <= 0.0 || !watch_.everAccepted() || watch_.age(ros::Time::now()) <= timeout_) return;
  ROS_WARN("%s: nothing for %g s, now taken as zero", watch_.name().c_str(), timeout_);
  watch_.restart();
  on_wrench_(Wrench::Zero());
}

std::string WrenchInput::fault() const {
  return watch_.currentFault().empty() ? "" : watch_.name() + ": " + watch_.currentFault();
}

}  // namespace live_stiffness
