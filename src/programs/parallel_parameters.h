#pragma once
// Private parameters of parallel_node. config/parallel_node.yaml is their manual.

#include <ros/node_handle.h>

#include <string>

#include "live_stiffness/parallel/parallel_model.h"
#include "ros/conversions.h"
#include "programs/parallel_markers.h"

namespace live_stiffness {

struct ParallelParameters {
  ParallelScene scene;
  ParallelOptions model;
  double length_unit = 1.0;      // m per unit of the lengths on the topic
  double length_timeout = 0.5;   // s
  double wrench_timeout = 1.0;   // s; 0: keep the last one for ever
  double heartbeat = 1.0;        // Hz
  FrameNames frames;             // B, P
  ParallelMarkerStyle style;     // its frame is that of B
  double marker_rate = 10.0;     // Hz
};

// Reads and validates all of them. Throws ConfigurationError with every fault. Warns of unknown ones.
ParallelParameters loadParallelParameters(const ros::NodeHandle& private_node);

}  // namespace live_stiffness
