#pragma once
// Bags as recordings: what RigBag writes, or a driver of its kind.

#include <string>

#include "live_stiffness/estimation/recording.h"
#include "live_stiffness/ros/conversions.h"

namespace live_stiffness {

// One sample per pose of aurora_pose that is valid, with the newest chamber_pressures and tip_force_torque before it,
// by their stamps (time of recording where they have none). Poses before the first pressures, and messages that
// cannot be read, are left out with a warning. Throws ConfigurationError when the file cannot be read or no sample is
// left.
Recording loadRecordedBag(const std::string& path, const PressureFormat& format = {}, double position_unit = 1.0);

}  // namespace live_stiffness
