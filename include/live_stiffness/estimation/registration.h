#pragma once
// Where the robot stands in the tracker's frame, and where the tracker's sensor sits on the tip.

#include <string>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

struct Registration {
  static constexpr double kLargestDelay = 1.0;  // s, either way
  Pose X_AB;  // base plate B in the tracker frame A, m
  Pose X_TS;  // tracker sensor S on the tip: offset from T in axes of T (m), and its constant rotation
  double tracker_delay = 0.0;  // s by which the tracker's poses are later than the pressures; see tracker_delay.h

  // Pose of the sensor in A for a tip pose in B, and the inverse.
  Pose sensorPose(const Pose& X_BT) const { return X_AB * X_BT * X_TS; }
  Pose tipPose(const Pose& X_AS) const { return X_AB.inverse() * X_AS * X_TS.inverse(); }
};

// Registration files (YAML):
//   base_in_tracker: {position_m: [x, y, z], quaternion_wxyz: [w, x, y, z]}    # X_AB
//   sensor_on_tip: {position_m: [x, y, z], quaternion_wxyz: [w, x, y, z]}      # X_TS
//   tracker_delay_s: 0.0                                                       # -1 to 1; may be left out
// The poses are required; quaternions are normalised; their norm must be 1e-3 to 1e3.
// Both throw ConfigurationError with every fault (key, value, legal range, line).
Registration loadRegistrationFile(const std::string& path);
Registration parseRegistration(const std::string& yaml, const std::string& name);

// Text that parseRegistration reads back to rounding (17 digits). Each line of `comment` becomes a comment on top.
std::string registrationText(const Registration& registration, const std::string& comment = "");

// Writes registrationText to a file; throws ConfigurationError if it cannot be written.
void saveRegistrationFile(const std::string& path, const Registration& registration, const std::string& comment = "");

}  // namespace live_stiffness
