#include "calibration/compliance_table.h"

#include <algorithm>
#include <sstream>

#include "estimation/recording_columns.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {

std::vector<ComplianceRow> parseComplianceTable(const std::string& csv, const std::string& name, int chamber_count) {
  FaultList faults("compliance table " + name);
  std::istringstream text(csv);
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> header = splitCsvLine(line);
  std::vector<std::string> wanted;
  for (int k = 1; k <= chamber_count; ++k) wanted.push_back("pressure_" + std::to_string(k) + "_pa");
  for (int j = 1; j <= 3; ++j)
    for (int i = 1; i <= 3; ++i) wanted.push_back("c" + std::to_string(i) + std::to_string(j) + "_m_per_n");
  std::vector<size_t> columns;
  for (const std::string& column : wanted) {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end()) faults.add("column " + column + " is missing");
    columns.push_back(static_cast<size_t>(found - header.begin()));
  }
  faults.throwIfAny();
  std::vector<ComplianceRow> rows;
  for (int number = 2; std::getline(text, line); ++number) {
    const std::vector<std::string> fields = splitCsvLine(line);
    if (fields.size() == 1 && fields[0].empty()) continue;
    const std::string where = "line " + std::to_string(number);
    if (fields.size() != header.size()) {
      faults.add(where + ": " + std::to_string(fields.size()) + " fields: must be " + std::to_string(header.size()));
      continue;
    }
    std::vector<double> values;
    for (size_t k = 0; k < columns.size(); ++k) {
      const std::optional<double> value = finiteNumber(fields[columns[k]]);
      if (!value) faults.add(where + ": " + wanted[k] + " = '" + fields[columns[k]] + "': must be a finite number");
      values.push_back(value.value_or(0.0));
    }
    ComplianceRow row;
    row.name = name + " " + where;
    row.pressures = Eigen::Map<const Eigen::VectorXd>(values.data(), chamber_count);
    row.compliance = Eigen::Map<const Matrix3>(values.data() + chamber_count);  // column by column
    if (!(row.compliance.norm() > 0.0)) faults.add(where + ": compliance is zero");
    rows.push_back(row);
  }
  if (rows.empty()) faults.add("no row");
  faults.throwIfAny();
  return rows;
}

std::vector<ComplianceRow> loadComplianceTable(const std::string& path, int chamber_count) {
  return parseComplianceTable(readTextFile("compliance table", path), path, chamber_count);
}

}  // namespace live_stiffness
