#pragma once
// Reads ROS parameters into fields. What is missing leaves its field alone; what has the wrong type does too, and is a
// fault. Ranges are checked afterwards, by FaultList::checkAll(). Keys of faults come without "~".

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include <cmath>
#include <set>
#include <string>
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
  void operator()(const NumberParameter& parameter, double& si);
  template <class Whole>
  void operator()(const NumberParameter& parameter, Whole& value);
  void operator()(const BooleanParameter& parameter, bool& value);
  void operator()(const ChoiceParameter& parameter, std::string& value);
  void operator()(const TextParameter& parameter, std::string& value);
  void operator()(const FrameParameter& parameter, std::string& value);
  void operator()(const NumbersParameter& parameter, std::vector<double>& values);
  void operator()(const NumbersParameter& parameter, std::vector<int>& values);  // whole numbers
  void operator()(const TextsParameter& parameter, std::vector<std::string>& values);

  // What `load` makes of the file at a path, if there is one; its faults are taken over.
  template <class Value, class Load>
  void file(const FileParameter& parameter, Load load, Value& value);
  // The same of a file that must be there.
  template <class Value, class Load>
  void requiredFile(const FileParameter& parameter, Load load, Value& value);

  // Warns of private parameters that nobody asked for: likely misspelt.
  void warnOfUnknown(const std::string& node) const;

 private:
  // The value of a key, or nullptr if it is not set.
  XmlRpc::XmlRpcValue* find(const char* key);
  bool number(const NumberParameter& parameter, double& value);
  void text(const char* key, std::string& value);
  // Fills a list if the value is one of elements that `read` takes, else adds a fault.
  template <class Element, class Read>
  void list(const char* key, const std::string& wanted, Read read, std::vector<Element>& values);
  void wrongType(const char* key, const std::string& wanted);

  XmlRpc::XmlRpcValue values_;
  FaultList& faults_;
  std::set<std::string> asked_{"exit_without_master", "diagnostic_period"};  // by runNode() and diagnostic_updater
};

// Adds a fault unless base and body are two different names. body: the parameter that names it.
void checkFrames(const FrameNames& frames, const FrameParameter& body, FaultList& faults);

template <class Whole>
void ParameterReader::operator()(const NumberParameter& parameter, Whole& value) {
  double read;
  if (!number(parameter, read)) return;
  if (parameter.range.contains(read) && read == std::floor(read)) value = static_cast<Whole>(read);
  else faults_.add(parameter.key + (" = " + numberText(read)) + ": must be a whole number, " + parameter.range.text());
}

template <class Value, class Load>
void ParameterReader::file(const FileParameter& parameter, Load load, Value& value) {
  std::string path;
  text(parameter.key, path);
  if (path.empty()) return;
  try {
    value = load(path);
  } catch (const ConfigurationError& error) {
    for (const std::string& fault : error.faults()) faults_.add(parameter.key + (" " + path) + ": " + fault);
  }
}

template <class Value, class Load>
void ParameterReader::requiredFile(const FileParameter& parameter, Load load, Value& value) {
  std::string path;
  text(parameter.key, path);
  if (path.empty()) faults_.add(std::string(parameter.key) + " is missing: must be the path of a file");
  file(parameter, load, value);
}

}  // namespace live_stiffness
