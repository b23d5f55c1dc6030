#pragma once
// The process of every node: its main function, and a look at the master.

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <atomic>
#include <csignal>
#include <exception>
#include <string>

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

// Runs a node until SIGINT or SIGTERM. Node: constructed from a public and a private ros::NodeHandle; throws
// ConfigurationError on bad parameters. Returns the exit status: 0 in good order; 2 bad parameters, listed in the log;
// 3 the master could not be reached for 10 s and ~exit_without_master is true, as launch files with respawn:=true set it.
template <class Node>
int runNode(int argc, char** argv, const std::string& name) {
  ros::init(argc, argv, name);
  // These outlive the node, because roscpp and its log shut down with the last handle.
  ros::NodeHandle handle, private_handle("~");
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });  // roscpp itself handles SIGINT only
  try {
    const Node node(handle, private_handle);
    const MasterCheck master(private_handle.param("exit_without_master", false));
    ros::spin();
    return master.hasShutDown() ? 3 : 0;
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
}

}  // namespace live_stiffness
