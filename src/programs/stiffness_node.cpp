// stiffness_node: the node that watches a fluidic soft robot; config/stiffness_node.yaml has its parameters.

#include <ros/ros.h>

#include "ros/node_process.h"
#include "ros/stiffness_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "stiffness_node");
  // Outlive the try block: with the last handle roscpp shuts down, and its log with it.
  ros::NodeHandle handle, private_handle("~");
  const live_stiffness::NodeProcess process;
  try {
    live_stiffness::StiffnessNode node(handle, private_handle);
    process.spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
  return 0;
}
