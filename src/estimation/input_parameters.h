#pragma once
// How to read what a rig sends, or has recorded: the parameters that turn messages into pressures and poses of a robot. The node
// and every program that reads bags have them. live_stiffness/parameters.h says what each is.

#include <string>
#include <vector>

#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/parameters.h"
#include "units.h"

namespace live_stiffness {

// Unit and reference of a rig's pressures.
struct PressureFormat {
  std::string unit = kPressureUnit.standard, reference = kPressureReference.standard;
  double atmosphere = kAtmosphericPressure.standard;  // subtracted from absolute ones, Pa

  template <class Format, class Visit>
  static void forEachParameter(Format& format, Visit&& visit) {
    visit(kPressureUnit, format.unit);
    visit(kPressureReference, format.reference);
    visit(kAtmosphericPressure, format.atmosphere);
  }
  bool isAbsolute() const { return reference == "absolute"; }
  double gauge(double value) const;  // Pa
};

// Frames that a message may refer to: the fixed one and, unless empty, that of the body which the robot moves.
struct FrameNames {
  std::string base, body;
};

struct InputParameters {
  PressureFormat pressure_format;
  std::vector<std::string> pressure_topics;  // one sensor_msgs/FluidPressure topic per channel; empty: one topic
  std::vector<int> channel_of_chamber;       // empty: one channel per chamber
  double pressure_timeout = kPressureTimeout.standard;  // s

  std::string position_unit = kPositionUnit.standard;        // of the tracker's positions
  std::string tracker_measures = kTrackerMeasures.standard;
  std::string tracker_frame = kTrackerFrame.standard;        // A
  std::string sensor_frame = kSensorFrame.standard;          // the tracker's name of the sensor; empty: the first one seen
  std::string tracker_tf_frame = kTrackerTfFrame.standard;   // look it up in tf instead of a topic; empty: topic
  double pose_timeout = kPoseTimeout.standard;               // s
  double tip_wrench_timeout = kTipWrenchTimeout.standard;    // s; 0: keep the last one for ever
  FrameNames frames{kBaseFrame.standard, kTipFrame.standard};  // B, and T as predicted

  template <class Parameters, class Visit>
  static void forEachParameter(Parameters& p, Visit&& visit) {
    PressureFormat::forEachParameter(p.pressure_format, visit);
    visit(kPressureTopics, p.pressure_topics);
    visit(kChannelOfChamber, p.channel_of_chamber);
    visit(kPressureTimeout, p.pressure_timeout);
    visit(kPositionUnit, p.position_unit);
    visit(kTrackerMeasures, p.tracker_measures);
    visit(kTrackerFrame, p.tracker_frame);
    visit(kSensorFrame, p.sensor_frame);
    visit(kTrackerTfFrame, p.tracker_tf_frame);
    visit(kPoseTimeout, p.pose_timeout);
    visit(kTipWrenchTimeout, p.tip_wrench_timeout);
    visit(kBaseFrame, p.frames.base);
    visit(kTipFrame, p.frames.body);
  }
  // Adds a fault for what is legal alone and does not fit together. chambers: of the scene; 0: not known.
  void check(int chambers, FaultList& faults) const;
};

// Adds a fault unless base and body are two different names. body: the parameter that names it.
void checkFrames(const FrameNames& frames, const FrameParameter& body, FaultList& faults);

}  // namespace live_stiffness
