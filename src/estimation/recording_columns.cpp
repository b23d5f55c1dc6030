#include "recording_columns.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>
#include <sstream>

namespace live_stiffness {
namespace {

class Header {
 public:
  Header(const std::vector<std::string>& names, FaultList& faults) : faults_(faults) {
    for (size_t i = 0; i < names.size(); ++i)
      if (!names[i].empty() && !column_of_.emplace(names[i], static_cast<int>(i)).second)
        faults.add("column " + names[i] + " is given more than once");
  }

  bool has(const std::string& name) const { return column_of_.count(name) > 0; }

  int find(const std::string& name) {
    const auto column = column_of_.find(name);
    if (column != column_of_.end()) {
      asked_.insert(*column);
      return column->second;
    }
    faults_.add("column " + name + " is missing");
    return 0;
  }

  std::array<int, 3> xyz(const std::string& stem, const std::string& unit) {
    return {find(stem + "_x_" + unit), find(stem + "_y_" + unit), find(stem + "_z_" + unit)};
  }

  // Three columns that may be missing all together, but not one by one.
  std::optional<std::array<int, 3>> optionalXyz(const std::string& stem, const std::string& unit) {
    for (const char* axis : {"_x_", "_y_", "_z_"})
      if (has(stem + axis + unit)) return xyz(stem, unit);
    return std::nullopt;
  }

  void warnOfUnknown(std::vector<std::string>& warnings) const {
    for (const auto& [name, column] : column_of_)
      if (asked_.count(name) == 0)
        warnings.push_back("line 1: column " + std::to_string(column + 1) + ", " + name + ", is not known and ignored");
  }

 private:
  FaultList& faults_;
  std::map<std::string, int> column_of_, asked_;
};

// Channel number of "pressure_K" + suffix; 0 if the name is not of this form.
int channelOf(const std::string& name, const std::string& suffix) {
  const std::string stem = "pressure_";
  if (name.size() <= stem.size() + suffix.size() || name.compare(0, stem.size(), stem) != 0 ||
      name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0)
    return 0;
  const std::string digits = name.substr(stem.size(), name.size() - stem.size() - suffix.size());
  if (digits.size() > 4 || digits.find_first_not_of("0123456789") != std::string::npos || digits[0] == '0') return 0;
  return std::stoi(digits);
}

std::vector<int> findPressures(const std::vector<std::string>& names, Header& header, bool& absolute,
                               FaultList& faults) {
  int highest[2] = {0, 0};  // channel number of gauge, absolute columns
  const std::string suffix[2] = {"_pa", "_pa_abs"};
  for (const std::string& name : names)
    for (int kind : {0, 1}) highest[kind] = std::max(highest[kind], channelOf(name, suffix[kind]));
  if (highest[0] > 0 && highest[1] > 0) faults.add("pressures are both gauge and absolute: must be one of the two");
  if (highest[0] == 0 && highest[1] == 0)
    faults.add("pressure columns are missing: must be pressure_1_pa_abs (absolute) or pressure_1_pa (gauge), ...");
  absolute = highest[1] > 0;
  std::vector<int> columns;
  for (int channel = 1; channel <= highest[absolute]; ++channel)
    columns.push_back(header.find("pressure_" + std::to_string(channel) + suffix[absolute]));
  return columns;
}

}  // namespace

RecordingColumns findColumns(const std::string& line, std::vector<std::string>& warnings, FaultList& faults) {
  const std::string byte_order_mark = "\xEF\xBB\xBF";  // spreadsheets write one
  const bool has_mark = line.compare(0, byte_order_mark.size(), byte_order_mark) == 0;
  RecordingColumns columns;
  columns.names = splitCsvLine(has_mark ? line.substr(byte_order_mark.size()) : line);
  Header header(columns.names, faults);
  columns.time = header.find("time_s");
  columns.pressures = findPressures(columns.names, header, columns.absolute, faults);
  columns.tip_position = header.xyz("tip", "m");
  columns.tip_orientation = {header.find("tip_qw"), header.find("tip_qx"), header.find("tip_qy"),
                             header.find("tip_qz")};
  columns.base = header.optionalXyz("base", "m");
  columns.force = header.optionalXyz("force", "n");
  columns.torque = header.optionalXyz("torque", "nm");
  // A sensor measures both; half of a wrench would be taken for a whole one.
  if (columns.force && !columns.torque) header.xyz("torque", "nm");
  if (columns.torque && !columns.force) header.xyz("force", "n");
  header.warnOfUnknown(warnings);
  return columns;
}

std::vector<std::string> splitCsvLine(const std::string& line) {
  std::vector<std::string> fields;
  size_t start = 0;
  while (true) {
    const size_t comma = line.find(',', start);
    const std::string field = line.substr(start, comma == std::string::npos ? comma : comma - start);
    const size_t first = field.find_first_not_of(" \t\r");
    const size_t last = field.find_last_not_of(" \t\r");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
    if (comma == std::string::npos) return fields;
    start = comma + 1;
  }
}

std::optional<double> finiteNumber(const std::string& field) {
  std::istringstream text(field);
  text.imbue(std::locale::classic());
  double value = 0.0;
  if (!(text >> value) || !text.eof() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace live_stiffness
