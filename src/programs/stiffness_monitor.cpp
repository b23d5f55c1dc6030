// stiffness_monitor: prints one line a second about a running stiffness_node, for machines without a display.

#include <ros/ros.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "live_stiffness/StiffnessEstimate.h"
#include "live_stiffness/TrackingError.h"

namespace {

using live_stiffness::StiffnessEstimate;
using live_stiffness::TrackingError;

class Monitor {
 public:
  explicit Monitor(ros::NodeHandle node)
      : estimates_(node.subscribe("stiffness_node/estimate", 100, &Monitor::onEstimate, this)),
        errors_(node.subscribe("stiffness_node/tracking_error", 100, &Monitor::onError, this)),
        timer_(node.createWallTimer(ros::WallDuration(1.0), &Monitor::onSecond, this)) {}

 private:
  void onEstimate(const StiffnessEstimate::ConstPtr& message) {
    newest_ = message;
    ++count_;
  }

  void onError(const TrackingError::ConstPtr& message) { tracking_error_ = message->distance; }

  void onSecond(const ros::WallTimerEvent&) {
    if (!newest_) {
      std::puts("waiting for estimates");
    } else {
      std::string pressures;
      for (double pressure : newest_->pressure) {
        char text[16];
        std::snprintf(text, sizeof text, " %.2f", 1e-5 * pressure);
        pressures += text;
      }
      const auto& tip = newest_->tip_pose.position;
      char error[32] = "no tracker";
      if (tracking_error_ >= 0.0) std::snprintf(error, sizeof error, "error %.2f mm", 1e3 * tracking_error_);
      std::printf("pressures%s bar | tip %.2f %.2f %.2f mm | compliance %.3f %.3f %.3f cm/N | %s | %ld Hz | "
                  "solve %.0f us%s%s\n",
                  pressures.c_str(), 1e3 * tip.x, 1e3 * tip.y, 1e3 * tip.z, 100 * newest_->compliance_eigenvalues[0],
                  100 * newest_->compliance_eigenvalues[1], 100 * newest_->compliance_eigenvalues[2], error, count_,
                  1e6 * newest_->solve_time, newest_->stale ? " | STALE: " : "", newest_->message.c_str());
    }
    std::fflush(stdout);
    count_ = 0;
    tracking_error_ = -1.0;
  }

  StiffnessEstimate::ConstPtr newest_;
  double tracking_error_ = -1.0;  // m; negative: none in this second
  long count_ = 0;                // estimates in this second
  ros::Subscriber estimates_, errors_;
  ros::WallTimer timer_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "stiffness_monitor");
  Monitor monitor{ros::NodeHandle()};
  ros::spin();
  return 0;
}
