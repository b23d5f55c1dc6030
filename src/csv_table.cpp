#include "csv_table.h"

#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>

namespace live_stiffness {

CsvTable::CsvTable(std::istream& input) : input_(input) {
  if (!readFields(names_)) names_ = {""};
  asked_.resize(names_.size(), false);
}

std::optional<int> CsvTable::find(const std::string& name) {
  std::optional<int> column;
  for (size_t k = names_.size(); k-- > 0;) {
    if (names_[k] != name) continue;
    asked_[k] = true;
    column = static_cast<int>(k);
  }
  return column;
}

int CsvTable::require(const std::string& name, FaultList& faults) {
  const std::optional<int> column = find(name);
  if (!column) faults.add("column " + name + " is missing");
  else if (std::count(names_.begin(), names_.end(), name) > 1) faults.add("column " + name + " is given more than once");
  return column.value_or(0);
}

std::vector<int> CsvTable::requireAll(const std::vector<std::string>& names, FaultList& faults) {
  std::vector<int> columns;
  for (const std::string& name : names) columns.push_back(require(name, faults));
  return columns;
}

std::vector<int> CsvTable::requireAllOrNone(const std::vector<std::string>& names, FaultList& faults) {
  const bool exists = std::any_of(names.begin(), names.end(), [&](const std::string& name) { return find(name).has_value(); });
  return exists ? requireAll(names, faults) : std::vector<int>();
}

std::vector<int> CsvTable::unknown() const {
  std::vector<int> columns;
  for (size_t k = 0; k < names_.size(); ++k)
    if (!asked_[k] && !names_[k].empty()) columns.push_back(static_cast<int>(k));
  return columns;
}

bool CsvTable::next(std::string& fault) {
  fault.clear();
  if (!readFields(fields_)) return false;
  if (fields_.size() != names_.size())
    fault = std::to_string(fields_.size()) + " fields: must be " + std::to_string(names_.size()) + ", as in the header";
  return true;
}

double CsvTable::number(int column, std::string& fault) const {
  const std::optional<double> value = finiteNumber(fields_[column]);
  if (!value && fault.empty()) fault = names_[column] + " = '" + fields_[column] + "': must be a finite number";
  return value.value_or(0.0);
}

Eigen::VectorXd CsvTable::numbers(const std::vector<int>& columns, std::string& fault) const {
  Eigen::VectorXd values(static_cast<long>(columns.size()));
  for (size_t k = 0; k < columns.size(); ++k) values[static_cast<long>(k)] = number(columns[k], fault);
  return values;
}

bool CsvTable::readFields(std::vector<std::string>& fields) {
  const std::string byte_order_mark = "\xEF\xBB\xBF";  // spreadsheets write one
  for (std::string line; std::getline(input_, line);) {
    if (++line_ == 1 && line.compare(0, byte_order_mark.size(), byte_order_mark) == 0) line.erase(0, byte_order_mark.size());
    fields = splitText(line, ',');
    if (fields.size() > 1 || !fields[0].empty()) return true;
  }
  return false;
}

std::vector<std::string> numberedColumns(const std::string& before, const std::string& after, int count) {
  std::vector<std::string> names;
  for (int k = 1; k <= count; ++k) names.push_back(before + std::to_string(k) + after);
  return names;
}

std::vector<std::string> splitText(const std::string& text, char separator) {
  const char* const blanks = " \t\r\n";
  std::vector<std::string> parts;
  for (size_t start = 0, end = 0; end != std::string::npos; start = end + 1) {
    end = text.find(separator, start);
    const std::string part = text.substr(start, end - start);
    const size_t first = part.find_first_not_of(blanks);
    parts.push_back(first == std::string::npos ? "" : part.substr(first, part.find_last_not_of(blanks) - first + 1));
  }
  return parts;
}

std::optional<double> finiteNumber(const std::string& text) {
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  char* end = nullptr;
  const double value = strtod_l(text.c_str(), &end, classic);
  const bool is_whole = !text.empty() && end == text.c_str() + text.size();  // not *end, which may be a NUL of the file
  if (!is_whole || !std::isfinite(value)) return std::nullopt;
  return value;
}

// The commas of a number may stand between thousands: each before three digits, and not in 0,060.
static bool areThousands(const std::string& number) {
  const char* const digits = "0123456789";
  for (size_t comma = number.find(','); comma != std::string::npos; comma = number.find(',', comma + 1))
    if (std::min(number.find_first_not_of(digits, comma + 1), number.size()) != comma + 4) return false;
  return number.find_first_of("123456789") < number.find(',');
}

std::string numberHint(const std::string& text) {
  const auto without = [](std::string from, const std::string& characters) {
    const auto is_one = [&](char c) { return characters.find(c) != std::string::npos; };
    from.erase(std::remove_if(from.begin(), from.end(), is_one), from.end());
    return from;
  };
  std::string plain = without(text, " _'\"");
  const std::string minus = "\xE2\x88\x92";  // U+2212, as word processors write it
  if (plain.compare(0, minus.size(), minus) == 0) plain.replace(0, minus.size(), "-");
  if (plain.find(',') != std::string::npos) {
    const size_t last = plain.rfind(',');
    const std::string thousands = areThousands(plain) ? without(plain, ",") : "";
    const std::string decimal =
        plain.find(',') == last ? without(plain.substr(0, last), ".") + "." + plain.substr(last + 1) : "";
    if (finiteNumber(decimal)) return "; write " + decimal + (finiteNumber(thousands) ? " or " + thousands : "");
    return finiteNumber(thousands) ? "; write " + thousands : "";
  }
  if (finiteNumber(plain)) return "; write " + plain;
  const auto may_begin_unit = [](unsigned char c) { return ((c | 32) >= 'a' && (c | 32) <= 'z') || c == '%' || c > 127; };
  for (size_t size = plain.size(); size-- > 0;)
    if (finiteNumber(plain.substr(0, size)) && may_begin_unit(plain[size]))
      return "; write the number alone, " + plain.substr(0, size) + ", in the unit that the key ends in";
  return "";
}

std::optional<std::vector<double>> numberList(const std::string& text, char separator) {
  std::vector<double> numbers;
  for (const std::string& part : splitText(text, separator)) {
    const std::optional<double> number = finiteNumber(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace live_stiffness
