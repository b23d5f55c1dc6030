#pragma once
// What a parameter is, and refusal of bad configuration: all faults at once, each with name, value and legal range.

#include <limits>
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

  static constexpr Range finite() { return {-kBeyond, kBeyond, true, true}; }
  static constexpr Range positive() { return {0.0, kBeyond, true, true}; }
  static constexpr Range nonnegative() { return {0.0, kBeyond, false, true}; }

 private:
  static constexpr double kBeyond = std::numeric_limits<double>::infinity();
};

// What is made again when a parameter of a running node changes, as a level of dynamic_reconfigure; kNo: it cannot be
// changed then.
struct Live {
  enum Level : unsigned { kNo = 0, kDisplay = 1, kContact = 2, kRobot = 4 };
};

// What is known of a parameter: its key, which ends in the unit of its value where it has one; its default, range and
// meaning. scripts/parameter_specs.py reads such definitions, so they keep to the form of live_stiffness/parameters.h.
struct NumberParameter {
  const char* key;
  double standard;  // the default, in the unit of the key; the range likewise
  Range range;
  const char* meaning;
  Live::Level live = Live::kNo;
  double unit = 1.0;  // SI value of the unit of the key, such as kDegree

  constexpr double si() const { return standard * unit; }
};
struct BooleanParameter {
  const char* key;
  bool standard;
  const char* meaning;
  Live::Level live = Live::kNo;
};
struct ChoiceParameter {
  const char* key;
  const char* standard;
  std::vector<std::string> choices;
  const char* meaning;
  Live::Level live = Live::kNo;

  bool has(const std::string& name) const;  // among the choices
  std::string text() const;                 // for people: all that are not empty, with commas between
};
struct TextParameter {
  const char* key;
  const char* standard;
  const char* meaning;
};
struct FrameParameter : TextParameter {};  // name of a frame, read without a leading slash
struct FileParameter : TextParameter {};   // path of a file; empty: none
struct NumbersParameter {
  const char* key;
  std::vector<double> standard;
  Range range;  // of each
  const char* meaning;
};
struct TextsParameter {  // empty by default
  const char* key;
  const char* meaning;
};

// Collects faults and throws them together.
class FaultList {
 public:
  // prefix: put before each fault, such as "~" before the keys of a node's parameters.
  explicit FaultList(std::string subject, std::string prefix = "")
      : subject_(std::move(subject)), prefix_(std::move(prefix)) {}

  void add(const std::string& fault) { faults_.push_back(prefix_ + fault); }
  // Adds "name = value: must be RANGE" unless the range contains the value.
  void check(const std::string& name, double value, const Range& range);
  // The same of a parameter; numbers are given in SI.
  void check(const NumberParameter& parameter, double value);
  void check(const ChoiceParameter& parameter, const std::string& value);
  template <class Number>
  void check(const NumbersParameter& parameter, const std::vector<Number>& values) {
    for (size_t i = 0; i < values.size(); ++i)
      check(parameter.key + ("[" + std::to_string(i) + "]"), static_cast<double>(values[i]), parameter.range);
  }
  void check(const BooleanParameter&, bool) {}  // has no range, nor have texts
  void check(const TextParameter&, const std::string&) {}
  void check(const TextsParameter&, const std::vector<std::string>&) {}
  // Checks all parameters of a struct that has forEachParameter().
  template <class Options>
  void checkAll(const Options& options) {
    Options::forEachParameter(options, [this](const auto& parameter, const auto& value) { this->check(parameter, value); });
  }
  bool empty() const { return faults_.empty(); }
  const std::vector<std::string>& faults() const { return faults_; }
  // Throws ConfigurationError if there is any fault.
  void throwIfAny() const;

 private:
  std::string subject_, prefix_;
  std::vector<std::string> faults_;
};

// The text of a file. Throws ConfigurationError about `subject` (such as "scene") when it cannot be read.
std::string readTextFile(const std::string& subject, const std::string& path);

// All texts in one line, with "; " between them.
std::string oneLine(const std::vector<std::string>& texts);

// A number as people write it: shortest text that reads back to the same value up to 6 digits. With a decimal point
// whatever the locale of the process.
std::string numberText(double value);
// The same with a number of digits after the point.
std::string fixedText(double value, int decimals);

}  // namespace live_stiffness
