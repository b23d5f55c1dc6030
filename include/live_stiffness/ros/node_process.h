#pragma once
// What every node's process does beside its work: it stops in good order on SIGTERM as on SIGINT, and when the master
// was restarted it registers there anew.

#include <ros/ros.h>

#include <csignal>

#include "live_stiffness/ros/master_watch.h"

namespace live_stiffness {

class NodeProcess {
 public:
  // After ros::init() and the first NodeHandle, which installs roscpp's own handler of SIGINT.
  NodeProcess() { std::signal(SIGTERM, [](int) { ros::requestShutdown(); }); }

 private:
  MasterWatch master_;
};

}  // namespace live_stiffness
