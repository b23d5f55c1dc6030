#pragma once
// Says in the log when the ROS master cannot be reached.

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <atomic>

namespace live_stiffness {

// Checks the master once a second, in its own thread: if the master's computer is switched off, one check may take two
// minutes.
class MasterCheck {
 public:
  // shuts_down: ends this process when the master could not be reached for 10 s.
  explicit MasterCheck(bool shuts_down) : shuts_down_(shuts_down), spinner_(1, &queue_) {
    ros::NodeHandle node;
    node.setCallbackQueue(&queue_);
    timer_ = node.createWallTimer(ros::WallDuration(1.0), &MasterCheck::onTimer, this);
    spinner_.start();
  }
  MasterCheck(const MasterCheck&) = delete;  // the callback refers to it

  // True if the process ends because the master cannot be reached.
  bool hasShutDown() const { return shuts_down_ && is_lost_; }

 private:
  void onTimer(const ros::WallTimerEvent&) {
    const ros::WallDuration longest(10.0);
    const bool is_there = ros::master::check();
    const ros::WallTime now = ros::WallTime::now();
    if (is_there) {
      if (is_lost_) ROS_WARN("the master can be reached again. If it was restarted, it does not know this node: start it again");
      last_answer_ = now;
      is_lost_ = false;
    } else if (!is_lost_ && now - last_answer_ >= longest && ros::ok()) {
      is_lost_ = true;
      ROS_ERROR("the master at %s cannot be reached for %.0f s: %s", ros::master::getURI().c_str(),
                (now - last_answer_).toSec(),
                shuts_down_ ? "this process ends with status 3" : "connected nodes keep working, but new nodes cannot connect");
      if (shuts_down_) ros::requestShutdown();
    }
  }

  const bool shuts_down_;
  std::atomic<bool> is_lost_{false};
  ros::WallTime last_answer_ = ros::WallTime::now();
  ros::CallbackQueue queue_;
  ros::WallTimer timer_;
  ros::AsyncSpinner spinner_;  // last: stops first
};

}  // namespace live_stiffness
