#include "estimation/recording_columns.h"

#include <algorithm>
#include <cstdio>

namespace live_stiffness {
namespace {

std::array<std::string, 3> xyzNames(const std::string& stem, const std::string& unit) {
  return {stem + "_x_" + unit, stem + "_y_" + unit, stem + "_z_" + unit};
}

std::array<int, 3> requireXyz(CsvTable& table, const std::string& stem, const std::string& unit, FaultList& faults) {
  const auto names = xyzNames(stem, unit);
  return {table.require(names[0], faults), table.require(names[1], faults), table.require(names[2], faults)};
}

// Three columns that may be missing all together, but not one by one.
std::optional<std::array<int, 3>> findXyz(CsvTable& table, const std::string& stem, const std::string& unit,
                                          FaultList& faults) {
  for (const std::string& name : xyzNames(stem, unit))
    if (table.find(name)) return requireXyz(table, stem, unit, faults);
  return std::nullopt;
}

// Columns pressure_K_pa or pressure_K_pa_abs for K = 1, 2, ... without gaps.
std::vector<int> findPressures(CsvTable& table, bool& absolute, FaultList& faults) {
  int highest[2] = {0, 0};  // channel of gauge, absolute columns
  for (const std::string& name : table.names()) {
    int channel = 0, end = 0;
    if (std::sscanf(name.c_str(), "pressure_%4d_pa%n", &channel, &end) != 1 || end == 0) continue;
    const std::string suffix = name.substr(end);
    if (suffix.empty() || suffix == "_abs") highest[!suffix.empty()] = std::max(highest[!suffix.empty()], channel);
  }
  if (highest[0] > 0 && highest[1] > 0) faults.add("pressures are both gauge and absolute: must be one of the two");
  if (highest[0] <= 0 && highest[1] <= 0)
    faults.add("pressure columns are missing: must be pressure_1_pa_abs (absolute) or pressure_1_pa (gauge), ...");
  absolute = highest[1] > 0;
  std::vector<int> columns;
  for (int channel = 1; channel <= highest[absolute]; ++channel)
    columns.push_back(table.require("pressure_" + std::to_string(channel) + (absolute ? "_pa_abs" : "_pa"), faults));
  return columns;
}

}  // namespace

RecordingColumns findColumns(CsvTable& table, std::vector<std::string>& warnings, FaultList& faults) {
  RecordingColumns columns;
  columns.time = table.require("time_s", faults);
  columns.pressures = findPressures(table, columns.absolute, faults);
  columns.tip_position = requireXyz(table, "tip", "m", faults);
  const char* const orientation[] = {"tip_qw", "tip_qx", "tip_qy", "tip_qz"};
  for (int i = 0; i < 4; ++i) columns.tip_orientation[i] = table.require(orientation[i], faults);
  columns.base = findXyz(table, "base", "m", faults);
  columns.force = findXyz(table, "force", "n", faults);
  columns.torque = findXyz(table, "torque", "nm", faults);
  // A sensor measures both; half of a wrench would be taken for a whole one.
  if (columns.force && !columns.torque) requireXyz(table, "torque", "nm", faults);
  if (columns.torque && !columns.force) requireXyz(table, "force", "n", faults);
  for (int column : table.unknown())
    warnings.push_back("line " + std::to_string(table.line()) + ": column " + std::to_string(column + 1) + ", " +
                       table.names()[column] + ", is not known and ignored");
  return columns;
}

}  // namespace live_stiffness
