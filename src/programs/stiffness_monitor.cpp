// stiffness_monitor: prints one line a second about a running stiffness_node or parallel_node, for machines without a
// display.

#include <ros/ros.h>

#include <cstdio>
#include <string>

#include "live_stiffness/PlatformEstimate.h"
#include "live_stiffness/StiffnessEstimate.h"
#include "live_stiffness/TrackingError.h"
#include "ros/node_process.h"

namespace {

using live_stiffness::PlatformEstimate;
using live_stiffness::StiffnessEstimate;
using live_stiffness::TrackingError;

// "name v v v unit", each value times `factor`.
template <class Values>
std::string listText(const std::string& name, const Values& values, double factor, const char* format,
                     const std::string& unit) {
  std::string text = name;
  for (double value : values) {
    char number[32];
    std::snprintf(number, sizeof number, format, factor * value);
    text += number;
  }
  return text + " " + unit;
}

std::string positionText(const std::string& name, const geometry_msgs::Pose& pose) {
  const double position[] = {pose.position.x, pose.position.y, pose.position.z};
  return listText(name, position, 1e3, " %.2f", "mm");
}

class Monitor {
 public:
  Monitor(ros::NodeHandle node, const ros::NodeHandle&)
      : estimates_(node.subscribe("stiffness_node/estimate", 100, &Monitor::onEstimate, this)),
        platform_estimates_(node.subscribe("parallel_node/estimate", 100, &Monitor::onPlatformEstimate, this)),
        errors_(node.subscribe("stiffness_node/tracking_error", 100, &Monitor::onError, this)),
        timer_(node.createWallTimer(ros::WallDuration(1.0), &Monitor::onSecond, this)) {}

 private:
  void onEstimate(const StiffnessEstimate::ConstPtr& message) {
    newest_ = message;
    ++count_;
  }
  void onPlatformEstimate(const PlatformEstimate::ConstPtr& message) {
    newest_of_platform_ = message;
    ++count_;
  }
  void onError(const TrackingError::ConstPtr& message) { tracking_error_ = message->distance; }

  template <class Estimate>
  void print(const std::string& beginning, const Estimate& estimate) const {
    std::printf("%s | %ld Hz | solve %.0f us%s%s\n", beginning.c_str(), count_, 1e6 * estimate.solve_time,
                estimate.stale ? " | STALE: " : "", estimate.message.c_str());
  }

  void onSecond(const ros::WallTimerEvent&) {
    if (!newest_ && !newest_of_platform_) std::puts("waiting for estimates");
    if (newest_) {
      char error[32] = "no tracker";
      if (tracking_error_ >= 0.0) std::snprintf(error, sizeof error, "error %.2f mm", 1e3 * tracking_error_);
      print(listText("pressures", newest_->pressure, 1e-5, " %.2f", "bar") +
                positionText(" | tip", newest_->tip_pose) +
                listText(" | compliance", newest_->compliance_eigenvalues, 100.0, " %.3f", "cm/N") + " | " + error,
            *newest_);
    }
    if (newest_of_platform_)
      print(listText("lengths", newest_of_platform_->length, 1e3, " %.2f", "mm") +
                positionText(" | platform", newest_of_platform_->platform_pose) +
                listText(" | compliance", newest_of_platform_->compliance_eigenvalues, 1e3, " %.4f", "mm/N"),
            *newest_of_platform_);
    std::fflush(stdout);
    count_ = 0;
    tracking_error_ = -1.0;
  }

  StiffnessEstimate::ConstPtr newest_;
  PlatformEstimate::ConstPtr newest_of_platform_;
  double tracking_error_ = -1.0;  // m; negative: none in this second
  long count_ = 0;                // estimates in this second
  ros::Subscriber estimates_, platform_estimates_, errors_;
  ros::WallTimer timer_;
};

}  // namespace

int main(int argc, char** argv) { return live_stiffness::runNode<Monitor>(argc, argv, "stiffness_monitor"); }
