#pragma once
// Reads ROS parameters into fields. What is missing leaves its field alone; what has the wrong type does too, and is a
// fault. Ranges are checked afterwards, by FaultList::checkAll(). Keys of faults come without "~".

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include <cmath>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "live_stiffness/parameters.h"
#include "ros/conversions.h"

namespace live_stiffness {

class ParameterReader {
 public:
  // Reads the private parameters of a node, or the members of a struct of values.
  ParameterReader(const ros::NodeHandle& private_node, FaultList& faults);
  ParameterReader(const XmlRpc::XmlRpcValue& values, FaultList& faults) : values_(values), faults_(faults) {}

  // si: the value in SI, whatever the unit of the key. Whole numbers are accepted where numbers are wanted.
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
  void operator()(const BooleanParameter& parameter, bool& value) {
    read(parameter.key, "true or false, without quotes", value);
  }
  void operator()(const ChoiceParameter& parameter, std::string& value) { read(parameter.key, "a text", value); }
  void operator()(const TextParameter& parameter, std::string& value) { read(parameter.key, "a text", value); }
  void operator()(const FrameParameter& parameter, std::string& value) {
    read(parameter.key, "a text", value);
    value = withoutSlash(value);
  }
  template <class Number>
  void operator()(const NumbersParameter& parameter, std::vector<Number>& values) {
    const std::string numbers = std::is_integral_v<Number> ? "whole numbers" : "numbers";
    read(parameter.key, "a list of " + numbers + ", each " + parameter.range.text(), values);
  }
  void operator()(const TextsParameter& parameter, std::vector<std::string>& values) {
    read(parameter.key, "a list of texts", values);
  }

  // What `load` makes of the file at a path, if there is one; its faults are taken over.
  template <class Value, class Load>
  void file(const FileParameter& parameter, Load load, Value& value, bool is_required = false) {
    std::string path;
    read(parameter.key, "a text", path);
    if (path.empty() && is_required)
      faults_.add(std::string(parameter.key) + " is missing: must be the path of a file (scene:=FILE of a launch file)");
    if (path.empty()) return;
    try {
      value = load(path);
    } catch (const ConfigurationError& error) {
      for (const std::string& fault : error.faults()) faults_.add(parameter.key + (" " + path) + ": " + fault);
    }
  }

  // Warns of private parameters that nobody asked for: likely misspelt.
  void warnOfUnknown(const std::string& node) const;

 private:
  // True if the key is set to a value of the field's type; a value of another type is a fault.
  template <class Field>
  bool read(const char* key, const std::string& wanted, Field& field) {
    asked_.insert(key);
    if (!values_.hasMember(key)) return false;
    Field found;
    const bool is_good = convert(values_[key], found);
    if (is_good) field = found;
    else faults_.add(key + (": must be " + wanted));
    return is_good;
  }
  static bool convert(XmlRpc::XmlRpcValue& value, double& number);
  static bool convert(XmlRpc::XmlRpcValue& value, int& number);
  template <class Field>  // bool or std::string
  static bool convert(XmlRpc::XmlRpcValue& value, Field& field) {
    constexpr bool is_bool = std::is_same_v<Field, bool>;
    if (value.getType() != (is_bool ? XmlRpc::XmlRpcValue::TypeBoolean : XmlRpc::XmlRpcValue::TypeString)) return false;
    field = static_cast<Field&>(value);
    return true;
  }
  template <class Element>
  static bool convert(XmlRpc::XmlRpcValue& value, std::vector<Element>& list) {
    if (value.getType() != XmlRpc::XmlRpcValue::TypeArray) return false;
    list.resize(value.size());
    for (size_t i = 0; i < list.size(); ++i)
      if (!convert(value[static_cast<int>(i)], list[i])) return false;
    return true;
  }

  XmlRpc::XmlRpcValue values_;
  FaultList& faults_;
  std::set<std::string> asked_{"exit_without_master", "diagnostic_period"};  // by runNode() and diagnostic_updater
};

// Adds a fault unless base and body are two different names. body: the parameter that names it.
void checkFrames(const FrameNames& frames, const FrameParameter& body, FaultList& faults);

}  // namespace live_stiffness
