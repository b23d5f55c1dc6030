#include "ros/parameter_reader.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

using XmlRpc::XmlRpcValue;

bool asNumber(XmlRpcValue& value, double& number) {
  if (value.getType() == XmlRpcValue::TypeDouble) number = static_cast<double>(value);
  else if (value.getType() == XmlRpcValue::TypeInt) number = static_cast<int>(value);
  else return false;
  return true;
}

}  // namespace

bool ParameterReader::find(const std::string& key, XmlRpcValue& value) {
  asked_.insert(key);
  return node_.getParam(key, value);
}

void ParameterReader::wrongType(const std::string& key, const std::string& wanted) {
  faults_.add("~" + key + ": must be " + wanted);
}

double ParameterReader::number(const std::string& key, double otherwise, const Range& range) {
  XmlRpcValue value;
  double number = otherwise;
  if (!find(key, value)) return otherwise;
  if (!asNumber(value, number)) {
    wrongType(key, "a number, " + range.text());
    return otherwise;
  }
  faults_.check("~" + key, number, range);
  return number;
}

bool ParameterReader::boolean(const std::string& key, bool otherwise) {
  XmlRpcValue value;
  if (!find(key, value)) return otherwise;
  if (value.getType() == XmlRpcValue::TypeBoolean) return static_cast<bool>(value);
  wrongType(key, "true or false, without quotes");
  return otherwise;
}

std::string ParameterReader::text(const std::string& key, const std::string& otherwise) {
  XmlRpcValue value;
  if (!find(key, value)) return otherwise;
  if (value.getType() == XmlRpcValue::TypeString) return static_cast<std::string>(value);
  wrongType(key, "a text");
  return otherwise;
}

std::string ParameterReader::choice(const std::string& key, const std::string& otherwise,
                                    const std::vector<std::string>& choices) {
  const std::string value = text(key, otherwise);
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return value;
  std::string known;
  for (const std::string& name : choices) known += (known.empty() ? "" : ", ") + name;
  faults_.add("~" + key + " = " + value + ": must be one of " + known);
  return otherwise;
}

std::vector<double> ParameterReader::numbers(const std::string& key, const std::vector<double>& otherwise,
                                             const Range& range) {
  XmlRpcValue value;
  if (!find(key, value)) return otherwise;
  std::vector<double> numbers;
  bool is_list = value.getType() == XmlRpcValue::TypeArray;
  for (int i = 0; is_list && i < value.size(); ++i) {
    numbers.push_back(0.0);
    is_list = asNumber(value[i], numbers.back());
    if (is_list) faults_.check("~" + key + "[" + std::to_string(i) + "]", numbers.back(), range);
  }
  if (is_list) return numbers;
  wrongType(key, "a list of numbers, each " + range.text());
  return otherwise;
}

std::vector<std::string> ParameterReader::texts(const std::string& key) {
  XmlRpcValue value;
  std::vector<std::string> texts;
  if (!find(key, value)) return texts;
  bool is_list = value.getType() == XmlRpcValue::TypeArray;
  for (int i = 0; is_list && i < value.size(); ++i) {
    is_list = value[i].getType() == XmlRpcValue::TypeString;
    if (is_list) texts.push_back(static_cast<std::string>(value[i]));
  }
  if (is_list) return texts;
  wrongType(key, "a list of texts");
  return {};
}

std::vector<int> ParameterReader::indices(const std::string& key) {
  constexpr double kLast = 1023.0;
  std::vector<int> indices;
  for (double index : numbers(key, {}, {0.0, kLast})) {
    if (index != std::floor(index)) wrongType(key, "a list of whole numbers");
    indices.push_back(static_cast<int>(index));
  }
  return indices;
}

std::vector<std::string> ParameterReader::unknown() const {
  std::vector<std::string> all, unknown;
  node_.getParamNames(all);
  const std::string prefix = node_.getNamespace() + "/";
  for (const std::string& name : all) {
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string key = name.substr(prefix.size());
    if (asked_.count(key.substr(0, key.find('/'))) == 0) unknown.push_back(key);
  }
  return unknown;
}

void readFrames(ParameterReader& read, const std::string& body_key, const std::string& body_default, FrameNames& frames,
                FaultList& faults) {
  frames = {withoutSlash(read.text("base_frame", "base")), withoutSlash(read.text(body_key, body_default))};
  if (frames.base.empty() || frames.body.empty() || frames.base == frames.body)
    faults.add("~base_frame = " + frames.base + ", ~" + body_key + " = " + frames.body +
               ": must be two different names");
}

}  // namespace live_stiffness
