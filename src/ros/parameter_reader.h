#pragma once
// Reads private ROS parameters; every fault is collected, none is fatal on its own.

#include <ros/node_handle.h>

#include <set>
#include <string>
#include <vector>

#include "live_stiffness/checks.h"
#include "ros/conversions.h"

namespace live_stiffness {

class ParameterReader {
 public:
  ParameterReader(const ros::NodeHandle& node, FaultList& faults) : node_(node), faults_(faults) {}

  // The parameter, or the default when it is not set. A wrong type or a value out of range is a fault, and the default
  // is returned. Whole numbers are accepted where numbers are wanted.
  double number(const std::string& key, double otherwise, const Range& range);
  bool boolean(const std::string& key, bool otherwise);
  std::string text(const std::string& key, const std::string& otherwise);
  // As text, but must be one of `choices`.
  std::string choice(const std::string& key, const std::string& otherwise, const std::vector<std::string>& choices);
  std::vector<double> numbers(const std::string& key, const std::vector<double>& otherwise, const Range& range);
  std::vector<std::string> texts(const std::string& key);

  // A list of whole numbers from 0 to 1023; empty when not set.
  std::vector<int> indices(const std::string& key);
  // What `load` makes of the file that the parameter names. Its faults are taken over; not set is one when required.
  template <class Value, class Load>
  Value file(const std::string& key, Load load, bool is_required);

  // Private parameters that nobody asked for: likely misspelt.
  std::vector<std::string> unknown() const;

 private:
  // True if the parameter is set.
  bool find(const std::string& key, XmlRpc::XmlRpcValue& value);
  void wrongType(const std::string& key, const std::string& wanted);

  ros::NodeHandle node_;
  FaultList& faults_;
  std::set<std::string> asked_{"exit_without_master"};  // this one by runNode()
};

// Names of ~base_frame (default: base) and of the frame that `body_key` names; a fault unless they are two.
void readFrames(ParameterReader& read, const std::string& body_key, const std::string& body_default, FrameNames& frames,
                FaultList& faults);

template <class Value, class Load>
Value ParameterReader::file(const std::string& key, Load load, bool is_required) {
  const std::string path = text(key, "");
  if (path.empty()) {
    if (is_required) faults_.add("~" + key + " is missing: must be the path of a file");
    return Value();
  }
  try {
    return load(path);
  } catch (const ConfigurationError& error) {
    for (const std::string& fault : error.faults()) faults_.add("~" + key + " " + path + ": " + fault);
    return Value();
  }
}

}  // namespace live_stiffness
