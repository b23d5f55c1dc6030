#pragma once
// A known external wrench on the body that the robot moves, from a topic, in the axes of the base or of the body.

#include <optional>
#include <string>

#include "ros/conversions.h"
#include "ros/input_status.h"

namespace live_stiffness {

class WrenchInput {
 public:
  // timeout: s without a message after which the wrench counts as zero; 0: never.
  WrenchInput(const std::string& topic, FrameNames frames, double timeout)
      : frames_(std::move(frames)), timeout_(timeout), status_(topic) {}

  // [f; m] in base axes. None if the message cannot be used. X_BT: of the body in the base frame; nullptr: not known yet.
  std::optional<Wrench> read(const geometry_msgs::WrenchStamped& message, const Pose* X_BT) {
    const Parsed<Wrench> wrench = readWrench(message, frames_, X_BT);
    if (!wrench.ok()) {
      status_.reject(wrench.error);
      return std::nullopt;
    }
    status_.accept(ros::Time());  // timed by its arrival
    return wrench.value;
  }
  // True once when the last wrench is older than the timeout: it is zero from then on. To be called now and then.
  bool expires() {
    if (timeout_ <= 0.0 || !status_.hasMessage() || status_.age() <= timeout_) return false;
    ROS_WARN("%s: no message for %g s, now counts as zero", status_.name().c_str(), timeout_);
    status_.restart();
    return true;
  }
  const InputStatus& status() const { return status_; }
  // What was wrong with the newest message, with the name of the topic; empty: nothing.
  std::string error() const { return status_.error().empty() ? "" : status_.name() + ": " + status_.error(); }

 private:
  FrameNames frames_;
  double timeout_;
  InputStatus status_;
};

}  // namespace live_stiffness
