#pragma once
// Arguments of stiffness_map.

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/pressure_plan.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

struct MapArguments {
  std::string scene, model, stepping, criterion = "largest_eigenstiffness", compliance = "tangent", output = "-";
  std::string channel_of_chamber, find, direction = "x", at;
  std::vector<std::string> pressures;
  double accuracy = 1e-6, max_bar = 1.0, tolerance_mm = 0.1;
  long random = 0;
  std::uint64_t seed = 1;
  int channels = 0, threads = 0, starts = 24;
};

// Of --pressures; faults are added.
std::vector<PressureRange> readRanges(const MapArguments& arguments, FaultList& faults);

// Of --channel-of-chamber or --channels. Throws ConfigurationError.
ChannelMap readChannels(const MapArguments& arguments, int chambers);

}  // namespace live_stiffness
