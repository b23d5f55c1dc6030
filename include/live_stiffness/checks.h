#pragma once
// Refusal of bad configuration: all faults at once, each with name, value and legal range.

#include <stdexcept>
#include <string>
#include <vector>

namespace live_stiffness {

// Thrown for a bad scene file, bad options or bad parameters. what() lists every fault, one a line.
class ConfigurationError : public std::runtime_error {
 public:
  ConfigurationError(const std::string& subject, std::vector<std::string> faults);
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::vector<std::string> faults_;
};

// An interval of legal values; a bound is included unless it is marked open. NaN is never legal.
struct Range {
  double low = 0.0;
  double high = 0.0;
  bool low_open = false;
  bool high_open = false;

  bool contains(double value) const;
  std::string text() const;  // for people: "> 0", "0 to 0.5", "any finite number"

  static Range finite();
  static Range positive();
  static Range nonnegative();
};

// Collects faults and throws them together.
class FaultList {
 public:
  explicit FaultList(std::string subject) : subject_(std::move(subject)) {}

  void add(const std::string& fault) { faults_.push_back(fault); }
  // Adds "name = value: must be RANGE" unless the range contains the value.
  void check(const std::string& name, double value, const Range& range);
  bool empty() const { return faults_.empty(); }
  const std::vector<std::string>& faults() const { return faults_; }
  // Throws ConfigurationError if there is any fault.
  void throwIfAny() const;

 private:
  std::string subject_;
  std::vector<std::string> faults_;
};

// The text of a file. Throws ConfigurationError about `subject` (such as "scene") when it cannot be read.
std::string readTextFile(const std::string& subject, const std::string& path);

// All texts in one line, with "; " between them.
std::string oneLine(const std::vector<std::string>& texts);

// A number as people write it: shortest text that reads back to the same value up to 6 digits.
std::string numberText(double value);

}  // namespace live_stiffness
