#include "input_table.h"

#include <algorithm>
#include <cstdlib>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

const char* const kWrenchColumns[6] = {"fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"};

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r\n";
  const size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result;
  size_t start = 0;
  for (size_t comma = 0; comma != std::string::npos; start = comma + 1) {
    comma = line.find(',', start);
    result.push_back(trimmed(line.substr(start, comma == std::string::npos ? comma : comma - start)));
  }
  return result;
}

}  // namespace

std::vector<std::string> numberedColumns(const std::string& before, const std::string& after, int count) {
  std::vector<std::string> names;
  for (int k = 1; k <= count; ++k) names.push_back(before + std::to_string(k) + after);
  return names;
}

InputTable::InputTable(std::istream& input, std::vector<std::string> inputs)
    : input_(input), inputs_(static_cast<int>(inputs.size())) {
  FaultList faults("header of the table on standard input");
  std::string line;
  while (std::getline(input_, line)) {
    ++line_;
    if (!trimmed(line).empty()) break;
  }
  std::vector<std::string> wanted = inputs;
  wanted.insert(wanted.end(), std::begin(kWrenchColumns), std::end(kWrenchColumns));
  std::vector<int> seen(wanted.size(), 0);
  names_ = fields(line);
  for (const std::string& name : names_) {
    const auto place = std::find(wanted.begin(), wanted.end(), name);
    if (place == wanted.end()) {
      faults.add("column " + (name.empty() ? "(empty)" : name) + ": unknown; known are " + inputs.front() + " to " +
                 inputs.back() + " and fx_n, fy_n, fz_n, mx_nm, my_nm, mz_nm");
      continue;
    }
    slots_.push_back(static_cast<int>(place - wanted.begin()));
    if (++seen[slots_.back()] == 2) faults.add("column " + name + ": given more than once");
  }
  const bool has_wrench = std::any_of(seen.begin() + inputs_, seen.end(), [](int count) { return count > 0; });
  for (size_t k = 0; k < wanted.size(); ++k)
    if (seen[k] == 0 && (has_wrench || k < static_cast<size_t>(inputs_)))
      faults.add("column " + wanted[k] + " is missing" + (k < static_cast<size_t>(inputs_) ? "" :
                 ": give all six of the wrench or none"));
  faults.throwIfAny();
}

bool InputTable::next(InputRow& row) {
  std::string line;
  do {
    if (!std::getline(input_, line)) return false;
    ++line_;
  } while (trimmed(line).empty());
  row = InputRow();
  row.line = line_;
  row.values.setZero(inputs_);
  const std::vector<std::string> texts = fields(line);
  if (texts.size() != slots_.size()) {
    row.fault = std::to_string(texts.size()) + " fields, but the header has " + std::to_string(slots_.size());
    return true;
  }
  for (size_t i = 0; i < texts.size(); ++i) {
    char* end = nullptr;
    const double value = std::strtod(texts[i].c_str(), &end);
    if (texts[i].empty() || end != texts[i].c_str() + texts[i].size()) {  // not *end, which may be a NUL of the file
      row.fault = names_[i] + " = " + (texts[i].empty() ? "(empty)" : texts[i]) + ": must be a number";
      return true;
    }
    if (slots_[i] < inputs_) row.values[slots_[i]] = value;
    else row.wrench[slots_[i] - inputs_] = value;
  }
  return true;
}

}  // namespace live_stiffness
