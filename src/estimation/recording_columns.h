#pragma once
// Which column of a recording's CSV holds what, and what is wrong with its header.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "csv_table.h"

namespace live_stiffness {

struct RecordingColumns {
  int time = 0;
  std::vector<int> pressures;  // of channel 1, 2, ...
  bool absolute = false;
  std::array<int, 3> tip_position{};
  std::array<int, 4> tip_orientation{};  // w, x, y, z
  std::optional<std::array<int, 3>> base;
  std::optional<std::array<int, 3>> force, torque;  // both or none
};

// Adds a fault for every column that is missing or repeated, a warning for those not known.
RecordingColumns findColumns(CsvTable& table, std::vector<std::string>& warnings, FaultList& faults);

}  // namespace live_stiffness
