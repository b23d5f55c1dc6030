#pragma once
// A stiffness_node under test, driven by pressures as by a rig: its newest messages, and whether any estimate was ever
// not finite.

#include <algorithm>
#include <string>
#include <vector>

#include "ros/conversions.h"
#include "support/estimate_checks.h"
#include "support/ros_wait.h"

namespace live_stiffness {

inline Pressures pressuresOf(const std::vector<double>& values) {
  Pressures result(values.size());
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

inline std::string parameter(const std::string& key) {
  std::string value;
  ros::NodeHandle("~").getParam(key, value);
  return value;
}

// One node: what it publishes.
class Watched {
 public:
  explicit Watched(const std::string& name)
      : estimates_(node_.subscribe(name + "/estimate", 100, &Watched::onEstimate, this)),
        errors_(node_.subscribe(name + "/tracking_error", 100, &Watched::onError, this)),
        forces_(node_.subscribe(name + "/tip_wrench_estimate", 100, &Watched::onForce, this)) {}

  bool solvedFor(const Pressures& values) const {
    return estimate && !estimate->stale && estimate->pressure.size() == static_cast<size_t>(values.size()) &&
           Pressures::Map(estimate->pressure.data(), values.size()) == values;
  }

  StiffnessEstimate::ConstPtr estimate;
  TrackingError::ConstPtr error;
  geometry_msgs::WrenchStamped::ConstPtr force;
  long estimates = 0;
  bool always_finite = true;

 private:
  void onEstimate(const StiffnessEstimate::ConstPtr& message) {
    estimate = message;
    ++estimates;
    always_finite = always_finite && isFinite(*message);
  }
  void onError(const TrackingError::ConstPtr& message) { error = message; }
  void onForce(const geometry_msgs::WrenchStamped::ConstPtr& message) { force = message; }

  ros::NodeHandle node_;
  ros::Subscriber estimates_, errors_, forces_;
};

// Calls publish() again and again, as a rig does, until the condition holds.
template <class Publish, class Condition>
bool publishUntil(Publish publish, Condition condition, double timeout_s = 20.0) {
  ros::WallTime last(0);
  return waitFor(
      [&] {
        if (ros::WallTime::now() - last > ros::WallDuration(0.05)) {
          last = ros::WallTime::now();
          publish();
        }
        return condition();
      },
      timeout_s);
}

}  // namespace live_stiffness
