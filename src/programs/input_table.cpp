#include "input_table.h"

#include <algorithm>

namespace live_stiffness {
namespace {

const std::vector<std::string> kWrenchColumns = {"fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"};

}  // namespace

std::vector<std::string> numberedColumns(const std::string& before, const std::string& after, int count) {
  std::vector<std::string> names;
  for (int k = 1; k <= count; ++k) names.push_back(before + std::to_string(k) + after);
  return names;
}

InputTable::InputTable(std::istream& input, const std::vector<std::string>& inputs) : table_(input) {
  FaultList faults("header of the table on standard input");
  for (const std::string& name : inputs) inputs_.push_back(table_.require(name, faults));
  const auto isThere = [&](const std::string& name) { return table_.find(name).has_value(); };
  if (std::any_of(kWrenchColumns.begin(), kWrenchColumns.end(), isThere)) {
    if (!std::all_of(kWrenchColumns.begin(), kWrenchColumns.end(), isThere))
      faults.add("columns of the wrench: give all six or none");
    for (const std::string& name : kWrenchColumns) wrench_.push_back(table_.require(name, faults));
  }
  for (int column : table_.unknown())
    faults.add("column " + table_.names()[column] + ": unknown; known are " + inputs.front() + " to " + inputs.back() +
               " and fx_n, fy_n, fz_n, mx_nm, my_nm, mz_nm");
  faults.throwIfAny();
}

bool InputTable::next(InputRow& row) {
  row = InputRow();
  if (!table_.next(row.fault)) return false;
  row.line = table_.line();
  row.values.setZero(static_cast<long>(inputs_.size()));
  if (!row.fault.empty()) return true;
  for (size_t k = 0; k < inputs_.size(); ++k) row.values[k] = table_.number(inputs_[k], row.fault);
  for (size_t k = 0; k < wrench_.size(); ++k) row.wrench[k] = table_.number(wrench_[k], row.fault);
  return true;
}

}  // namespace live_stiffness
