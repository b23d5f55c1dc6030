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
  std::vector<int> columns;
  for (int k = 1; k <= chamber_count; ++k) columns.push_back(table.require("pressure_" + std::to_string(k) + "_pa", faults));
  for (int j = 1; j <= 3; ++j)
    for (int i = 1; i <= 3; ++i)
      columns.push_back(table.require("c" + std::to_string(i) + std::to_string(j) + "_m_per_n", faults));
  faults.throwIfAny();
  std::vector<ComplianceRow> rows;
  for (std::string fault; table.next(fault);) {
    const std::string where = "line " + std::to_string(table.line());
    std::vector<double> values;
    for (size_t k = 0; k < columns.size() && fault.empty(); ++k) values.push_back(table.number(columns[k], fault));
    if (!fault.empty()) {
      faults.add(where + ": " + fault);
      continue;
    }
    ComplianceRow row;
    row.name = name + " " + where;
    row.pressures = Eigen::Map<const Eigen::VectorXd>(values.data(), chamber_count);
    row.compliance = Eigen::Map<const Matrix3>(values.data() + chamber_count);  // column by column
    if (!(row.compliance.norm() > 0.0)) faults.add(where + ": compliance is zero");
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
