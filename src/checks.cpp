#include "live_stiffness/checks.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <locale>
#include <sstream>

namespace live_stiffness {
namespace {

std::string joined(const std::string& subject, const std::vector<std::string>& faults) {
  std::string text = subject + ": " + std::to_string(faults.size()) + (faults.size() == 1 ? " fault" : " faults");
  for (const std::string& fault : faults) text += "\n  - " + fault;
  return text;
}

}  // namespace

ConfigurationError::ConfigurationError(const std::string& subject, std::vector<std::string> faults)
    : std::runtime_error(joined(subject, faults)), faults_(std::move(faults)) {}

bool Range::contains(double value) const {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return std::isfinite(value) && above && below;
}

std::string Range::text() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  if (!has_low && !has_high) return "any finite number";
  const std::string above = (low_open ? "> " : ">= ") + numberText(low);
  const std::string below = (high_open ? "< " : "<= ") + numberText(high);
  if (!has_high) return above;
  if (!has_low) return below;
  return above + " and " + below;
}

bool ChoiceParameter::has(const std::string& name) const {
  return std::find(choices.begin(), choices.end(), name) != choices.end();
}

std::string ChoiceParameter::text() const {
  std::string text;
  for (const std::string& name : choices)
    if (!name.empty()) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void FaultList::check(const std::string& name, double value, const Range& range) {
  if (!range.contains(value)) add(name + " = " + numberText(value) + ": must be " + range.text());
}

// Compared in SI, so that a bound in degrees is legal also when its radians are rounded.
void FaultList::check(const NumberParameter& parameter, double value) {
  Range range = parameter.range;
  range.low *= parameter.unit;
  range.high *= parameter.unit;
  if (!range.contains(value))
    add(parameter.key + (" = " + numberText(value / parameter.unit)) + ": must be " + parameter.range.text());
}

void FaultList::check(const ChoiceParameter& parameter, const std::string& value) {
  if (!parameter.has(value)) add(std::string(parameter.key) + " = " + value + ": must be one of " + parameter.text());
}

void FaultList::throwIfAny() const {
  if (!faults_.empty()) throw ConfigurationError(subject_, faults_);
}

std::string readTextFile(const std::string& subject, const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw ConfigurationError(subject + " " + path, {"cannot be read: it is a folder; must be the path of a file"});
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();  // of an empty file only the formatting flag says failure
  if (!file.is_open() || file.bad() || text.bad())
    throw ConfigurationError(subject + " " + path, {"cannot be read: must be the path of a file"});
  return text.str();
}

std::string oneLine(const std::vector<std::string>& texts) {
  std::string line;
  for (const std::string& text : texts) line += (line.empty() ? "" : "; ") + text;
  return line;
}

std::string numberText(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

std::string fixedText(double value, int decimals) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

}  // namespace live_stiffness
