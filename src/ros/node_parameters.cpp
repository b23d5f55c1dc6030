#include "ros/node_parameters.h"

#include <dynamic_reconfigure/Config.h>
#include <live_stiffness/StiffnessConfig.h>
#include <ros/names.h>

#include "live_stiffness/rod/scene_file.h"
#include "ros/parameter_reader.h"

namespace live_stiffness {
namespace {

void checkTopics(const std::vector<std::string>& topics, FaultList& faults) {
  for (const std::string& topic : topics) {
    std::string reason;
    if (!ros::names::validate(topic, reason) || topic.empty())
      faults.add(kPressureTopics.key + (": " + topic) + " is no topic name: " + reason);
  }
}

void checkChannels(const NodeParameters& p, FaultList& faults) {
  const size_t chambers = p.scene.chamberCount(), mapped = p.channel_of_chamber.size();
  if (chambers > 0 && mapped != 0 && mapped != chambers)
    faults.add(kChannelOfChamber.key + (" has " + std::to_string(mapped)) + " entries: must have one for each of the " +
               "scene's " + std::to_string(chambers) + " chambers, or be empty");
}

// Checks all, and sets what follows from what was read.
void complete(NodeParameters& p, FaultList& faults) {
  faults.checkAll(p);
  p.contact.checkComponents(faults);
  if (kModel.has(p.model_name) && kStepping.has(p.stepping_name))  // else told already
    p.model = namedModelOptions(p.model_name, p.stepping_name, faults, p.model);
  p.style.frame = p.frames.base;
  checkTopics(p.pressure_topics, faults);
  checkFrames(p.frames, kTipFrame, faults);
  checkChannels(p, faults);
  faults.throwIfAny();
}

XmlRpc::XmlRpcValue valuesOf(const StiffnessConfig& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  XmlRpc::XmlRpcValue values;
  for (const auto& entry : message.bools) values[entry.name] = XmlRpc::XmlRpcValue(entry.value != 0);
  for (const auto& entry : message.ints) values[entry.name] = XmlRpc::XmlRpcValue(entry.value);
  for (const auto& entry : message.doubles) values[entry.name] = XmlRpc::XmlRpcValue(entry.value);
  for (const auto& entry : message.strs) values[entry.name] = XmlRpc::XmlRpcValue(entry.value);
  return values;
}

}  // namespace

NodeParameters loadNodeParameters(const ros::NodeHandle& private_node) {
  FaultList faults("parameters of " + private_node.getNamespace(), "~");
  ParameterReader read(private_node, faults);
  NodeParameters parameters;
  NodeParameters::forEachParameter(parameters, read);
  read.file(kSceneFile, loadSceneFile, parameters.scene, true);
  read.file(kRegistrationFile, loadRegistrationFile, parameters.registration);
  parameters.is_registered = !parameters.registration_file.empty();
  read.warnOfUnknown("stiffness_node");
  complete(parameters, faults);
  return parameters;
}

NodeParameters reconfigured(NodeParameters parameters, const StiffnessConfig& config) {
  FaultList faults("reconfigure", "~");
  ParameterReader read(valuesOf(config), faults);
  NodeParameters::forEachParameter(parameters, read);
  complete(parameters, faults);
  return parameters;
}

}  // namespace live_stiffness
