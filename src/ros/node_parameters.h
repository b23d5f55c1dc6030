#pragma once
// Private parameters of stiffness_node. config/stiffness_node.yaml is their manual.

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "live_stiffness/compliance/model_options.h"
#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "live_stiffness/estimation/tip_wrench_options.h"
#include "ros/conversions.h"
#include "ros/marker_shapes.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

struct TipHandleOptions {
  bool enabled = true;
  double force_per_m = 20.0;     // N of force for each m the handle is dragged, and of the arrow drawn
  double moment_per_rad = 0.01;  // N m of moment for each rad the handle is turned
};

struct NodeParameters {
  Scene scene;
  ModelOptions model;
  EstimatorOptions estimator;
  double heartbeat = 1.0;  // Hz

  PressureFormat pressure_format;
  std::vector<std::string> pressure_topics;  // one sensor_msgs/FluidPressure topic per channel; empty: one topic
  std::vector<int> channel_of_chamber;       // empty: one channel per chamber
  double pressure_timeout = 0.5;             // s

  double position_unit = 1.0;   // m per unit of the tracker's positions
  std::string tracker_frame;    // A
  std::string sensor_frame;     // the tracker's name of the sensor, also accepted as frame_id
  std::string tracker_tf_frame;  // look the sensor up in tf under this name instead of a topic; empty: topic
  double pose_timeout = 1.0;    // s
  Registration registration;          // in use: loaded, until ~register applies another one
  std::string registration_file;      // that it was loaded from; empty: none
  double registration_buffer = 120.0;  // s of the past that ~register can use
  double tip_wrench_timeout = 1.0;  // s; 0: keep the last one for ever

  TipWrenchOptions contact;
  double contact_arrow_scale = 20.0;  // of the arrow drawn, N/m

  FrameNames frames;  // B, and T as predicted
  MarkerStyle style;             // its frame is that of B; its scale is the force in N whose displacement is drawn
  double marker_rate = 10.0;     // Hz
  bool show_eigenscrews = false;
  double eigenscrew_length = 0.06;  // of each axis drawn, m
  TipHandleOptions tip_handle;
};

// Reads and validates all of them. Throws ConfigurationError with every fault. Warns of unknown ones.
NodeParameters loadNodeParameters(const ros::NodeHandle& private_node);

}  // namespace live_stiffness
