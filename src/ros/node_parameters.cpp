#include "ros/node_parameters.h"

#include <XmlRpcValue.h>
#include <dynamic_reconfigure/Config.h>
#include <live_stiffness/StiffnessConfig.h>
#include <ros/console.h>
#include <ros/names.h>
#include <ros/param.h>

#include <locale>
#include <sstream>

#include "analysis/scene_description.h"
#include "live_stiffness/rod/scene_file.h"
#include "parameter_reader.h"

namespace live_stiffness {
namespace {

void checkTopics(const std::vector<std::string>& topics, FaultList& faults) {
  for (const std::string& topic : topics) {
    std::string reason;
    if (!ros::names::validate(topic, reason) || topic.empty())
      faults.add(kPressureTopics.key + (": " + topic) + " is no topic name: " + reason);
  }
}

// Checks all, and sets what follows from what was read.
void complete(NodeParameters& p, FaultList& faults) {
  faults.checkAll(p);
  p.contact.checkComponents(faults);
  if (kModel.has(p.model_name) && kStepping.has(p.stepping_name))  // else told already
    p.model = namedModelOptions(p.model_name, p.stepping_name, faults, p.model);
  p.style.frame = p.frames.base;
  checkTopics(p.pressure_topics, faults);
  p.check(p.scene.chamberCount(), faults);
  faults.throwIfAny();
}

std::string exactText(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << value;
  return text.str();
}

YAML::Node yamlOf(XmlRpc::XmlRpcValue value) {
  YAML::Node node;
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean: return YAML::Node(static_cast<bool>(value) ? "true" : "false");
    case XmlRpc::XmlRpcValue::TypeInt: return YAML::Node(std::to_string(static_cast<int>(value)));
    case XmlRpc::XmlRpcValue::TypeDouble: return YAML::Node(exactText(static_cast<double>(value)));
    case XmlRpc::XmlRpcValue::TypeString: return YAML::Node(static_cast<std::string&>(value));
    case XmlRpc::XmlRpcValue::TypeArray:
      node = YAML::Node(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) node.push_back(yamlOf(value[i]));
      return node;
    case XmlRpc::XmlRpcValue::TypeStruct:
      node = YAML::Node(YAML::NodeType::Map);
      for (auto& entry : value) node[entry.first] = yamlOf(entry.second);
      return node;
    default: return node;
  }
}

YAML::Node yamlOf(const StiffnessConfig& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  YAML::Node values;
  for (const auto& entry : message.bools) values[entry.name] = entry.value != 0 ? "true" : "false";
  for (const auto& entry : message.ints) values[entry.name] = std::to_string(entry.value);
  for (const auto& entry : message.doubles) values[entry.name] = exactText(entry.value);
  for (const auto& entry : message.strs) values[entry.name] = entry.value;
  return values;
}

}  // namespace

YAML::Node privateParameters(const ros::NodeHandle& private_node) {
  XmlRpc::XmlRpcValue values;
  return ros::param::get(private_node.getNamespace(), values) ? yamlOf(values) : YAML::Node();
}

NodeParameters readNodeParameters(const YAML::Node& values, const std::string& subject, const std::string& prefix,
                                  std::vector<std::string>& unknown) {
  FaultList faults(subject, prefix);
  ParameterReader read(values, faults);
  NodeParameters parameters;
  NodeParameters::forEachParameter(parameters, read);
  read.file(kSceneFile, loadSceneFile, parameters.scene, "must be the path of a scene; launch files take it as scene:=FILE");
  parameters.registration_file = read.file(kRegistrationFile, loadRegistrationFile, parameters.registration);
  parameters.is_registered = !parameters.registration_file.empty();
  complete(parameters, faults);
  unknown = read.unknown();
  return parameters;
}

NodeParameters loadNodeParameters(const ros::NodeHandle& private_node) {
  std::vector<std::string> unknown;
  const NodeParameters parameters = readNodeParameters(
      privateParameters(private_node), "parameters of " + private_node.getNamespace(), "~", unknown);
  warnOfUnknown(unknown, "stiffness_node");
  for (const std::string& doubt : doubtsAbout(parameters.scene)) ROS_WARN("scene: %s", doubt.c_str());
  return parameters;
}

void warnOfUnknown(const std::vector<std::string>& keys, const std::string& node) {
  for (const std::string& key : keys)
    if (!isReadByOthers(key))
      ROS_WARN("parameter ~%s is not known to %s", key.c_str(), node.c_str());
}

NodeParameters reconfigured(NodeParameters parameters, const StiffnessConfig& config) {
  FaultList faults("reconfigure", "~");
  ParameterReader read(yamlOf(config), faults);
  NodeParameters::forEachParameter(parameters, read);
  complete(parameters, faults);
  return parameters;
}

}  // namespace live_stiffness
