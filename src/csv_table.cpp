#include "csv_table.h"

#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string_view>

namespace live_stiffness {
namespace {

std::string_view trimmed(std::string_view text) {
  const char* const blanks = " \t\r\n";
  const size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// Also nan and inf.
std::optional<double> wholeNumber(const std::string& text) {
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  char* end = nullptr;
  const double value = strtod_l(text.c_str(), &end, classic);
  const bool is_whole = !text.empty() && end == text.c_str() + text.size();  // not *end, which may be a NUL of the file
  return is_whole ? std::optional<double>(value) : std::nullopt;
}

void setField(std::string_view text, std::string& field) {
  text = trimmed(text);
  const bool has_quotes = text.size() > 1 && text.front() == '"' && text.back() == '"';
  if (has_quotes) text = trimmed(text.substr(1, text.size() - 2));
  field = text;
  if (has_quotes)
    for (size_t k = 0; (k = field.find("\"\"", k)) != std::string::npos; ++k) field.erase(k, 1);
}

// A separator in quotes separates nothing. Returns what is wrong with the line; empty: nothing.
std::string split(const std::string& line, char separator, std::vector<std::string>& fields) {
  size_t count = 0;
  bool quoted = false;
  for (size_t start = 0, end = 0; start <= line.size(); start = end + 1) {
    for (end = start; end < line.size() && (quoted || line[end] != separator); ++end) quoted ^= line[end] == '"';
    if (count == fields.size()) fields.emplace_back();
    setField(std::string_view(line).substr(start, end - start), fields[count++]);
  }
  fields.resize(count);
  return quoted ? "a quote is open at the end of the line: must be closed in the same line" : "";
}

char separatorOf(const std::string& header) {
  const auto isRarer = [&](char a, char b) {
    return std::count(header.begin(), header.end(), a) < std::count(header.begin(), header.end(), b);
  };
  const char separators[] = {',', ';', '\t'};
  return *std::max_element(std::begin(separators), std::end(separators), isRarer);
}

char lowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// As in `p_1_pa` above `[kPa]`. Only of units that are likely to be meant.
bool contradicts(const std::string& name, const std::string& units) {
  const auto isLetter = [](char c) { return lowerCase(c) >= 'a' && lowerCase(c) <= 'z'; };
  const auto begin = std::find_if(units.begin(), units.end(), isLetter);
  std::string unit(begin, std::find_if_not(begin, units.end(), isLetter));
  std::transform(unit.begin(), unit.end(), unit.begin(), lowerCase);
  const char* const likely[] = {"ms", "us", "min", "mm", "cm", "hpa", "kpa", "mpa", "mbar", "bar", "psi", "nmm"};
  return std::find(std::begin(likely), std::end(likely), unit) != std::end(likely) &&
         (name + "_").find("_" + unit + "_") == std::string::npos;
}

}  // namespace

CsvTable::CsvTable(std::istream& input) : lines_(input) {
  std::string comment;
  size_t first = 0;
  while (lines_.next(text_)) {
    first = text_.find_first_not_of(" \t\",;");
    if (first == std::string::npos) continue;
    const bool is_comment = text_[first] == '#' || text_[first] == '%';
    if (is_comment) comment = text_.substr(std::min(text_.find_first_not_of("#% \t", first), text_.size()));
    else if (lines_.number() == 1 && text_.compare(0, 4, "sep=") == 0 && text_.size() > 4) separator_ = text_[4];
    else break;
  }
  const bool is_row = !comment.empty() && first < text_.size() && std::strchr("0123456789+-.", text_[first]) != nullptr;
  if (!is_row) comment = text_;
  if (separator_ == 0) separator_ = separatorOf(comment);
  split(comment, separator_, names_);
  while (names_.size() > 1 && names_.back().empty()) names_.pop_back();
  for (std::string& name : names_) std::transform(name.begin(), name.end(), name.begin(), lowerCase);
  asked_.resize(names_.size(), false);

  has_first_row_ = is_row ? splitRow() : readRow();
  const auto isNumber = [&](const std::string& field) { return parsed(field) || wholeNumber(field); };
  if (!has_first_row_ || !row_fault_.empty() || std::any_of(fields_.begin(), fields_.end(), isNumber)) return;
  has_first_row_ = false;
  units_ = fields_;
  units_.resize(names_.size());
  note_ = "line " + std::to_string(line()) + " has no number and is taken as a row of units: " + oneLine(units_);
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
  else if (!units_.empty() && contradicts(name, units_[*column]))
    faults.add("column " + name + " has '" + units_[*column] + "' in the row of units: must be the unit in its name");
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
  if (!has_first_row_ && !readRow()) return false;
  has_first_row_ = false;
  fault = row_fault_;
  if (fault.empty() && fields_.size() != names_.size())
    fault = std::to_string(fields_.size()) + " fields: must be " + std::to_string(names_.size()) + ", as in the header";
  return true;
}

double CsvTable::number(int column, std::string& fault) {
  const std::optional<double> value = parsed(fields_[column]);
  if (!value && fault.empty()) fault = names_[column] + " = '" + fields_[column] + "': must be a finite number";
  return value.value_or(0.0);
}

Eigen::VectorXd CsvTable::numbers(const std::vector<int>& columns, std::string& fault) {
  Eigen::VectorXd values(static_cast<long>(columns.size()));
  for (size_t k = 0; k < columns.size(); ++k) values[static_cast<long>(k)] = number(columns[k], fault);
  return values;
}

bool CsvTable::readRow() {
  while (lines_.next(text_))
    if (splitRow()) return true;
  return false;
}

bool CsvTable::splitRow() {
  row_fault_ = split(text_, separator_, fields_);
  while (fields_.size() > names_.size() && fields_.back().empty()) fields_.pop_back();
  const auto isBlank = [](const std::string& field) { return field.empty(); };
  return !row_fault_.empty() || !std::all_of(fields_.begin(), fields_.end(), isBlank);
}

// All numbers of a table have the same decimal mark, so that a comma between thousands is not read as one.
std::optional<double> CsvTable::parsed(const std::string& field) {
  const size_t mark = separator_ == ',' ? std::string::npos : field.find_first_of(".,");
  if (mark == std::string::npos) return finiteNumber(field);
  if (decimal_mark_ != 0 && field[mark] != decimal_mark_) return std::nullopt;
  std::string text = field;
  text[mark] = '.';
  const std::optional<double> value = finiteNumber(text);
  if (value) decimal_mark_ = field[mark];
  return value;
}

std::vector<std::string> numberedColumns(const std::string& before, const std::string& after, int count) {
  std::vector<std::string> names;
  for (int k = 1; k <= count; ++k) names.push_back(before + std::to_string(k) + after);
  return names;
}

std::vector<std::string> splitText(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (size_t start = 0, end = 0; end != std::string::npos; start = end + 1) {
    end = text.find(separator, start);
    parts.emplace_back(trimmed(std::string_view(text).substr(start, end - start)));
  }
  return parts;
}

std::optional<double> finiteNumber(const std::string& text) {
  const std::optional<double> value = wholeNumber(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
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
