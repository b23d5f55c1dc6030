#pragma once
// Reads parameters into fields, from YAML: of a node's private parameters (ros/node_parameters.h), of such a file and of command
// lines. What is missing leaves its field alone; what has the wrong type does too, and is a fault. Ranges are checked
// afterwards, by FaultList::checkAll(). Keys of faults come without "~".

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "live_stiffness/parameters.h"

namespace live_stiffness {

// "/aurora" -> "aurora"
std::string withoutSlash(const std::string& name);

// The parameters in a file as `rosparam dump` writes it: a mapping of keys to values, or of one node's name to that. Throws
// ConfigurationError when it cannot be read.
YAML::Node loadParameterFile(const std::string& path);

class ParameterReader {
 public:
  // values: a mapping, or nothing at all.
  ParameterReader(YAML::Node values, FaultList& faults) : values_(std::move(values)), faults_(faults) {}

  // si: the value in SI, whatever the unit of the key. A number that YAML 1.1 takes for a text, such as 1e-8, is one.
  void operator()(const NumberParameter& parameter, double& si) {
    double value;
    if (read(parameter.key, "a number, " + parameter.range.text(), value)) si = value * parameter.unit;
  }
  template <class Whole>
  void operator()(const NumberParameter& parameter, Whole& value) {
    double number;
    if (!read(parameter.key, "a number, " + parameter.range.text(), number)) return;
    if (parameter.range.contains(number) && number == std::floor(number)) value = static_cast<Whole>(number);
    else faults_.add(parameter.key + (" = " + numberText(number)) + ": must be a whole number, " + parameter.range.text());
  }
  void operator()(const BooleanParameter& parameter, bool& value) { read(parameter.key, "true or false", value); }
  void operator()(const ChoiceParameter& parameter, std::string& value) { read(parameter.key, "a text", value); }
  void operator()(const TextParameter& parameter, std::string& value) { read(parameter.key, "a text", value); }
  void operator()(const FrameParameter& parameter, std::string& value) {
    read(parameter.key, "a text", value);
    value = withoutSlash(value);
  }
  // Lists may be texts, too, such as "[0, 0, 1]": roscpp takes a list on the command line for one.
  template <class Number>
  void operator()(const NumbersParameter& parameter, std::vector<Number>& values) {
    const std::string numbers = std::is_integral_v<Number> ? "whole numbers" : "numbers";
    read(parameter.key, "a list of " + numbers + ", each " + parameter.range.text() + ", such as [0, 1]", values);
  }
  void operator()(const TextsParameter& parameter, std::vector<std::string>& values) {
    read(parameter.key, "a list of texts", values);
  }

  // What `load` makes of the file at a path, if there is one; its faults are taken over. Returns the path.
  template <class Value, class Load>
  std::string file(const FileParameter& parameter, Load load, Value& value, const std::string& needed_because = "") {
    std::string path;
    read(parameter.key, "a text", path);
    if (path.empty() && !needed_because.empty()) faults_.add(parameter.key + (" is missing: " + needed_because));
    if (path.empty()) return path;
    try {
      value = load(path);
    } catch (const ConfigurationError& error) {
      for (const std::string& fault : error.faults()) faults_.add(parameter.key + (" " + path) + ": " + fault);
    }
    return path;
  }

  // Keys that nobody asked for: likely misspelt.
  std::vector<std::string> unknown() const;

 private:
  // True if the key is set to a value of the field's type; a value of another type is a fault.
  template <class Field>
  bool read(const char* key, const std::string& wanted, Field& field) {
    asked_.insert(key);
    const YAML::Node value = values_.IsMap() ? values_[key] : YAML::Node(YAML::NodeType::Undefined);
    if (!value.IsDefined()) return false;
    Field found;
    const bool is_good = convert(value, found);
    if (is_good) field = found;
    else faults_.add(key + (" = " + textOf(value)) + ": must be " + wanted +
                     (std::is_same_v<Field, double> ? hintOf(value) : ""));
    return is_good;
  }
  static bool convert(const YAML::Node& value, double& number);
  static bool convert(const YAML::Node& value, int& number);
  static bool convert(const YAML::Node& value, bool& truth);
  static bool convert(const YAML::Node& value, std::string& text);
  static YAML::Node listOf(const YAML::Node& value);
  template <class Element>
  static bool convert(const YAML::Node& value, std::vector<Element>& list) {
    const YAML::Node elements = listOf(value);
    if (!elements.IsSequence()) return false;
    list.resize(elements.size());
    for (size_t i = 0; i < list.size(); ++i) {
      Element element;  // no reference into vector<bool>
      if (!convert(elements[i], element)) return false;
      list[i] = element;
    }
    return true;
  }
  static std::string textOf(const YAML::Node& value);
  static std::string hintOf(const YAML::Node& value);  // how to write a number

  const YAML::Node values_;
  FaultList& faults_;
  std::set<std::string> asked_;
};

}  // namespace live_stiffness
