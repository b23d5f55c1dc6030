#pragma once
// Private parameters of rig_simulator. rig/parameters.h says what each is.

#include <ros/node_handle.h>

#include <string>

#include "rig/rig_model.h"

namespace live_stiffness {

struct RigParameters {
  Scene scene;
  RigOptions options;
  double rate = kSampleRate.standard;                     // samples per second
  std::string tracker_frame = kRigTrackerFrame.standard;  // frame_id of the tracker's poses
  std::string base_frame = kRigBaseFrame.standard;        // frame_id of the true tip pose and of the true wrench
};

// Reads and validates all of them. Throws ConfigurationError with every fault. Warns of unknown ones.
RigParameters loadRigParameters(const ros::NodeHandle& private_node);

}  // namespace live_stiffness
