#pragma once
// Private parameters of stiffness_node. live_stiffness/parameters.h says what each is.

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "live_stiffness/compliance/model_options.h"
#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "live_stiffness/estimation/tip_wrench_estimator.h"
#include "ros/conversions.h"
#include "ros/marker_shapes.h"

namespace live_stiffness {

class StiffnessConfig;  // of dynamic_reconfigure

struct TipHandleOptions {
  bool enabled = kTipHandle.standard;
  double force_per_m = kTipHandleForce.standard;      // N of force for each m the handle is dragged, and of the arrow drawn
  double moment_per_rad = kTipHandleMoment.standard;  // N m of moment for each rad the handle is turned
};

struct NodeParameters {
  Scene scene;
  std::string model_name = kModel.standard, stepping_name = kStepping.standard;
  ModelOptions model;
  EstimatorOptions estimator;
  double heartbeat = kHeartbeat.standard;  // Hz

  PressureFormat pressure_format;
  std::vector<std::string> pressure_topics;  // one sensor_msgs/FluidPressure topic per channel; empty: one topic
  std::vector<int> channel_of_chamber;       // empty: one channel per chamber
  double pressure_timeout = kPressureTimeout.standard;  // s

  std::string position_unit = kPositionUnit.standard;        // of the tracker's positions
  std::string tracker_frame = kTrackerFrame.standard;        // A
  std::string sensor_frame = kSensorFrame.standard;          // the tracker's name of the sensor, also accepted as frame_id
  std::string tracker_tf_frame = kTrackerTfFrame.standard;   // look it up in tf instead of a topic; empty: topic
  double pose_timeout = kPoseTimeout.standard;               // s
  Registration registration;      // in use: loaded, until ~register applies another one
  std::string registration_file;  // that it was loaded from; empty: none
  bool is_registered = false;     // a registration was given, or applied by ~register
  double registration_buffer = kRegistrationBuffer.standard;  // s of the past that ~register can use
  double tip_wrench_timeout = kTipWrenchTimeout.standard;     // s; 0: keep the last one for ever

  TipWrenchOptions contact;
  double contact_arrow_scale = kContactArrow.standard;  // of the arrow drawn, N/m

  FrameNames frames{kBaseFrame.standard, kTipFrame.standard};  // B, and T as predicted
  MarkerStyle style;  // its frame is that of B; its scale is the force in N whose displacement is drawn
  double marker_rate = kMarkerRate.standard;  // Hz
  bool show_eigenscrews = kShowEigenscrews.standard;
  double eigenscrew_length = kEigenscrewLength.standard;  // of each axis drawn, m
  TipHandleOptions tip_handle;

  // Calls visit(parameter, field) for each parameter but the scene.
  template <class Parameters, class Visit>
  static void forEachParameter(Parameters& p, Visit&& visit) {
    visit(kModel, p.model_name);
    visit(kStepping, p.stepping_name);
    ModelOptions::forEachParameter(p.model, visit);
    EstimatorOptions::forEachParameter(p.estimator, visit);
    visit(kHeartbeat, p.heartbeat);
    PressureFormat::forEachParameter(p.pressure_format, visit);
    visit(kPressureTopics, p.pressure_topics);
    visit(kChannelOfChamber, p.channel_of_chamber);
    visit(kPressureTimeout, p.pressure_timeout);
    visit(kPositionUnit, p.position_unit);
    visit(kTrackerFrame, p.tracker_frame);
    visit(kSensorFrame, p.sensor_frame);
    visit(kTrackerTfFrame, p.tracker_tf_frame);
    visit(kPoseTimeout, p.pose_timeout);
    visit(kRegistrationFile, p.registration_file);
    visit(kRegistrationBuffer, p.registration_buffer);
    visit(kTipWrenchTimeout, p.tip_wrench_timeout);
    TipWrenchOptions::forEachParameter(p.contact, visit);
    visit(kContactArrow, p.contact_arrow_scale);
    visit(kBaseFrame, p.frames.base);
    visit(kTipFrame, p.frames.body);
    visit(kEllipsoidScale, p.style.ellipsoid_scale);
    visit(kMarkerRate, p.marker_rate);
    visit(kShowEigenscrews, p.show_eigenscrews);
    visit(kEigenscrewLength, p.eigenscrew_length);
    visit(kTipHandle, p.tip_handle.enabled);
    visit(kTipHandleForce, p.tip_handle.force_per_m);
    visit(kTipHandleMoment, p.tip_handle.moment_per_rad);
  }
};

// Reads and validates all of them. Throws ConfigurationError with every fault. Warns of unknown ones.
NodeParameters loadNodeParameters(const ros::NodeHandle& private_node);

// The parameters with those changed that dynamic_reconfigure can change. Throws ConfigurationError with every fault, NaN
// included, which dynamic_reconfigure itself lets through.
NodeParameters reconfigured(NodeParameters parameters, const StiffnessConfig& config);

}  // namespace live_stiffness
