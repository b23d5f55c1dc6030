#include "ros/parameter_reader.h"

#include <ros/console.h>

namespace live_stiffness {

using XmlRpc::XmlRpcValue;

ParameterReader::ParameterReader(const ros::NodeHandle& private_node, FaultList& faults) : faults_(faults) {
  if (!ros::param::get(private_node.getNamespace(), values_)) values_ = XmlRpcValue();
}

bool ParameterReader::convert(XmlRpcValue& value, double& number) {
  if (value.getType() == XmlRpcValue::TypeDouble) number = static_cast<double>(value);
  else if (value.getType() == XmlRpcValue::TypeInt) number = static_cast<int>(value);
  else return false;
  return true;
}

bool ParameterReader::convert(XmlRpcValue& value, int& number) {
  double read;
  if (!convert(value, read) || read != std::floor(read) || std::abs(read) > 1e9) return false;
  number = static_cast<int>(read);
  return true;
}

void ParameterReader::warnOfUnknown(const std::string& node) const {
  if (values_.getType() != XmlRpcValue::TypeStruct) return;
  for (const auto& entry : values_)
    if (asked_.count(entry.first) == 0)
      ROS_WARN("parameter ~%s is not known to %s", entry.first.c_str(), node.c_str());
}

void checkFrames(const FrameNames& frames, const FrameParameter& body, FaultList& faults) {
  if (frames.base.empty() || frames.body.empty() || frames.base == frames.body)
    faults.add(kBaseFrame.key + (" = " + frames.base) + ", " + body.key + " = " + frames.body +
               ": must be two different names");
}

}  // namespace live_stiffness
