#pragma once
// What every node's process does beside its work: it stops in good order on SIGTERM as on SIGINT, and when the master
// was restarted it registers there anew.

#include <ros/ros.h>

#include <csignal>

#include "ros/master_watch.h"

namespace live_stiffness {

class NodeProcess {
 public:
  // After ros::init() and the first NodeHandle, which installs roscpp's own handler of SIGINT.
  NodeProcess() { std::signal(SIGTERM, [](int) { ros::requestShutdown(); }); }

  // Until it is told to stop. Call it when all is advertised: what the first look at the master does not find there, the
  // next master is not told if this one dies within the second.
  void spin() const {
    const MasterWatch watch;
    ros::spin();
  }
};

}  // namespace live_stiffness
