#include "ros/parameter_reader.h"

#include <ros/console.h>

namespace live_stiffness {
namespace {

using XmlRpc::XmlRpcValue;

bool asNumber(XmlRpcValue& value, double& number) {
  if (value.getType() == XmlRpcValue::TypeDouble) number = static_cast<double>(value);
  else if (value.getType() == XmlRpcValue::TypeInt) number = static_cast<int>(value);
  else return false;
  return true;
}

bool asWhole(XmlRpcValue& value, int& number) {
  double read;
  if (!asNumber(value, read) || read != std::floor(read) || std::abs(read) > 1e9) return false;
  number = static_cast<int>(read);
  return true;
}

bool asText(XmlRpcValue& value, std::string& text) {
  if (value.getType() != XmlRpcValue::TypeString) return false;
  text = static_cast<std::string>(value);
  return true;
}

}  // namespace

ParameterReader::ParameterReader(const ros::NodeHandle& private_node, FaultList& faults) : faults_(faults) {
  if (!ros::param::get(private_node.getNamespace(), values_)) values_ = XmlRpcValue();
}

XmlRpcValue* ParameterReader::find(const char* key) {
  asked_.insert(key);
  return values_.getType() == XmlRpcValue::TypeStruct && values_.hasMember(key) ? &values_[key] : nullptr;
}

void ParameterReader::wrongType(const char* key, const std::string& wanted) {
  faults_.add(key + (": must be " + wanted));
}

bool ParameterReader::number(const NumberParameter& parameter, double& value) {
  XmlRpcValue* read = find(parameter.key);
  if (read == nullptr) return false;
  const bool is_number = asNumber(*read, value);
  if (!is_number) wrongType(parameter.key, "a number, " + parameter.range.text());
  return is_number;
}

void ParameterReader::text(const char* key, std::string& value) {
  XmlRpcValue* read = find(key);
  if (read != nullptr && !asText(*read, value)) wrongType(key, "a text");
}

template <class Element, class Read>
void ParameterReader::list(const char* key, const std::string& wanted, Read read, std::vector<Element>& values) {
  XmlRpcValue* found = find(key);
  if (found == nullptr) return;
  bool is_list = found->getType() == XmlRpcValue::TypeArray;
  std::vector<Element> elements(is_list ? found->size() : 0);
  for (size_t i = 0; i < elements.size(); ++i) is_list = is_list && read((*found)[static_cast<int>(i)], elements[i]);
  if (is_list) values = elements;
  else wrongType(key, wanted);
}

void ParameterReader::operator()(const NumberParameter& parameter, double& si) {
  double value;
  if (number(parameter, value)) si = value * parameter.unit;
}

void ParameterReader::operator()(const BooleanParameter& parameter, bool& value) {
  XmlRpcValue* read = find(parameter.key);
  if (read == nullptr) return;
  if (read->getType() == XmlRpcValue::TypeBoolean) value = static_cast<bool>(*read);
  else wrongType(parameter.key, "true or false, without quotes");
}

void ParameterReader::operator()(const ChoiceParameter& parameter, std::string& value) { text(parameter.key, value); }

void ParameterReader::operator()(const TextParameter& parameter, std::string& value) { text(parameter.key, value); }

void ParameterReader::operator()(const FrameParameter& parameter, std::string& value) {
  text(parameter.key, value);
  value = withoutSlash(value);
}

void ParameterReader::operator()(const NumbersParameter& parameter, std::vector<double>& values) {
  list(parameter.key, "a list of numbers, each " + parameter.range.text(), asNumber, values);
}

void ParameterReader::operator()(const NumbersParameter& parameter, std::vector<int>& values) {
  list(parameter.key, "a list of whole numbers, each " + parameter.range.text(), asWhole, values);
}

void ParameterReader::operator()(const TextsParameter& parameter, std::vector<std::string>& values) {
  list(parameter.key, "a list of texts", asText, values);
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
