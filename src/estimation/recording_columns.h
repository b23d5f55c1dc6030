#pragma once
// Header and fields of a recording's CSV: the meaning of each column, and the faults of the header.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/checks.h"

namespace live_stiffness {

struct RecordingColumns {
  std::vector<std::string> names;  // all of them, as in the header
  int time = -1;
  std::vector<int> pressures;  // of channel 1, 2, ...
  bool absolute = false;
  std::array<int, 3> tip_position{};
  std::array<int, 4> tip_orientation{};  // w, x, y, z
  std::optional<std::array<int, 3>> base;
  std::optional<std::array<int, 3>> force, torque;  // both or none
};

// Reads the header line; adds a fault for every column that is missing or repeated, a warning for those not known.
RecordingColumns findColumns(const std::string& header, std::vector<std::string>& warnings, FaultList& faults);

// Fields of one line, without blanks before and after; a carriage return counts as a blank. An empty line has one empty field.
std::vector<std::string> splitCsvLine(const std::string& line);

// A finite number that fills the whole field, with a decimal point in every locale.
std::optional<double> finiteNumber(const std::string& field);

}  // namespace live_stiffness
