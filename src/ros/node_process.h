#pragma once
// The main function of every node.

#include <ros/ros.h>

#include <csignal>
#include <exception>
#include <string>

#include "ros/master_check.h"

namespace live_stiffness {

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
