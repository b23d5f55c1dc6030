#include "parameter_reader.h"

#include "csv_table.h"

namespace live_stiffness {

std::string withoutSlash(const std::string& name) {
  return !name.empty() && name.front() == '/' ? name.substr(1) : name;
}

YAML::Node loadParameterFile(const std::string& path) {
  const std::string text = readTextFile("parameters", path);
  YAML::Node values;
  try {
    values = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw ConfigurationError("parameters " + path, {std::string("not YAML: ") + error.what()});
  }
  if (!values.IsMap())
    throw ConfigurationError("parameters " + path, {"must be a mapping of keys to values, as rosparam dump writes"});
  return values.size() == 1 && values.begin()->second.IsMap() ? values.begin()->second : values;
}

bool ParameterReader::convert(const YAML::Node& value, double& number) {
  const std::optional<double> read = value.IsScalar() ? finiteNumber(value.Scalar()) : std::nullopt;
  if (read) number = *read;
  return read.has_value();
}

bool ParameterReader::convert(const YAML::Node& value, int& number) {
  double read;
  if (!convert(value, read) || read != std::floor(read) || std::abs(read) > 1e9) return false;
  number = static_cast<int>(read);
  return true;
}

bool ParameterReader::convert(const YAML::Node& value, bool& truth) {
  return YAML::convert<bool>::decode(value, truth);
}

bool ParameterReader::convert(const YAML::Node& value, std::string& text) {
  if (!value.IsScalar() && !value.IsNull()) return false;
  text = value.IsNull() ? "" : value.Scalar();
  return true;
}

YAML::Node ParameterReader::listOf(const YAML::Node& value) {
  if (value.IsNull() || (value.IsScalar() && value.Scalar().empty())) return YAML::Node(YAML::NodeType::Sequence);
  try {
    return value.IsScalar() ? YAML::Load(value.Scalar()) : value;
  } catch (const YAML::Exception&) {
    return value;
  }
}

std::string ParameterReader::textOf(const YAML::Node& value) {
  return value.IsScalar() ? "'" + value.Scalar() + "'" : value.IsSequence() ? "a list" : value.IsNull() ? "nothing" : "a mapping";
}

std::string ParameterReader::hintOf(const YAML::Node& value) { return value.IsScalar() ? numberHint(value.Scalar()) : ""; }

std::vector<std::string> ParameterReader::unknown() const {
  std::vector<std::string> unknown;
  if (!values_.IsMap()) return unknown;
  for (const auto& entry : values_)
    if (entry.first.IsScalar() && asked_.count(entry.first.Scalar()) == 0) unknown.push_back(entry.first.Scalar());
  return unknown;
}

}  // namespace live_stiffness
