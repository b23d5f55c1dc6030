// stiffness_node: see config/stiffness_node.yaml for its parameters.

#include <ros/ros.h>

#include "live_stiffness/ros/stiffness_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "stiffness_node");
  try {
    live_stiffness::StiffnessNode node(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const live_stiffness::ConfigurationError& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
  return 0;
}
