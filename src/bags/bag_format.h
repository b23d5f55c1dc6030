#pragma once
// Topics and units of pressures, tracker and tip wrench in a bag.

#include <string>

#include "ros/conversions.h"

namespace live_stiffness {

// Topics with or without a leading slash. By default what recording_to_bag and simulate_bag write.
struct BagFormat {
  std::string pressure_topic = "chamber_pressures", pose_topic = "aurora_pose";
  std::string wrench_topic = "tip_force_torque";  // of the force sensor; replay reads a known wrench from tip_wrench instead
  PressureFormat pressures;
  double position_unit = 1.0;  // m per unit of the tracker's positions
};

}  // namespace live_stiffness
