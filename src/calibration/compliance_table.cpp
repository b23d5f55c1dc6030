#include "calibration/compliance_table.h"

#include <sstream>
#include <string>

#include "csv_table.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {

std::vector<ComplianceRow> parseComplianceTable(const std::string& csv, const std::string& name, int chamber_count) {
  FaultList faults("compliance table " + name);
  std::istringstream text(csv);
  CsvTable table(text);
  const std::vector<int> pressures = table.requireAll(numberedColumns("pressure_", "_pa", chamber_count), faults);
  std::vector<int> entries;  // column by column
  for (int j = 1; j <= 3; ++j)
    for (int i = 1; i <= 3; ++i)
      entries.push_back(table.require("c" + std::to_string(i) + std::to_string(j) + "_m_per_n", faults));
  faults.throwIfAny();
  std::vector<ComplianceRow> rows;
  for (std::string fault; table.next(fault);) {
    const std::string where = "line " + std::to_string(table.line());
    ComplianceRow row{name + " " + where, {}, Matrix3::Zero()};
    if (fault.empty()) {
      row.pressures = table.numbers(pressures, fault);
      row.compliance = Eigen::Map<const Matrix3>(table.numbers(entries, fault).data());
    }
    if (!fault.empty()) faults.add(where + ": " + fault);
    else if (!(row.compliance.norm() > 0.0)) faults.add(where + ": compliance is zero");
    rows.push_back(row);
  }
  if (rows.empty() && faults.empty()) faults.add("no row");
  faults.throwIfAny();
  return rows;
}

std::vector<ComplianceRow> loadComplianceTable(const std::string& path, int chamber_count) {
  return parseComplianceTable(readTextFile("compliance table", path), path, chamber_count);
}

}  // namespace live_stiffness
