#pragma once
// Private parameters of parallel_node. parallel/parameters.h says what each is.

#include <ros/node_handle.h>

#include <string>

#include "live_stiffness/parallel/parallel_model.h"
#include "parallel/parameters.h"
#include "ros/conversions.h"
#include "programs/parallel_markers.h"

namespace live_stiffness {

struct ParallelParameters {
  ParallelScene scene;
  ParallelOptions model;
  double heartbeat = kParallelHeartbeat.standard;  // Hz
  std::string length_unit_name = kLengthUnit.standard;
  double length_unit = 1.0;                             // m per unit of the lengths on the topic, by that name
  double length_timeout = kLengthTimeout.standard;      // s
  double wrench_timeout = kPlatformWrenchTimeout.standard;              // s; 0: keep the last one for ever
  FrameNames frames{kParallelBaseFrame.standard, kPlatformFrame.standard};  // B, P
  ParallelMarkerStyle style;                            // its frame is that of B
  double marker_rate = kParallelMarkerRate.standard;    // Hz

  template <class Parameters, class Visit>
  static void forEachParameter(Parameters& p, Visit&& visit) {
    visit(kParallelAccuracy, p.model.accuracy);
    visit(kParallelHeartbeat, p.heartbeat);
    visit(kLengthUnit, p.length_unit_name);
    visit(kLengthTimeout, p.length_timeout);
    visit(kPlatformWrenchTimeout, p.wrench_timeout);
    visit(kParallelBaseFrame, p.frames.base);
    visit(kPlatformFrame, p.frames.body);
    visit(kParallelEllipsoidScale, p.style.ellipsoid_scale);
    visit(kRotationEllipsoidScale, p.style.rotation_scale);
    visit(kParallelMarkerRate, p.marker_rate);
  }
};

// Reads and validates all of them. Throws ConfigurationError with every fault. Warns of unknown ones.
ParallelParameters loadParallelParameters(const ros::NodeHandle& private_node);

}  // namespace live_stiffness
