// Commands to a running StiffnessNode: ~reset, ~pause, ~reload and dynamic_reconfigure.

#include "ros/stiffness_node.h"

namespace live_stiffness {

void StiffnessNode::addServices() {
  servers_ = {private_node_.advertiseService("reset", &StiffnessNode::reset, this),
              private_node_.advertiseService("pause", &StiffnessNode::pause, this),
              private_node_.advertiseService("reload", &StiffnessNode::reload, this),
              private_node_.advertiseService("predict_deflection", &StiffnessNode::predictDeflection, this),
              private_node_.advertiseService("compliance_at", &StiffnessNode::complianceAt, this),
              private_node_.advertiseService("directional_stiffness", &StiffnessNode::directionalStiffness, this)};
  config_server_.getConfigDefault(config_);
  config_.__fromServer__(private_node_);  // the parameters were loaded from there
  config_server_.setCallback([this](StiffnessConfig& wanted, uint32_t level) { reconfigure(wanted, level); });
}

void StiffnessNode::setParameters(const NodeParameters& parameters, bool keeps_inputs) {
  const auto estimator = std::make_shared<StiffnessEstimator>(parameters.scene, parameters.model, parameters.estimator);
  auto contact = std::make_unique<TipWrenchEstimator>(parameters.scene, parameters.model, parameters.contact);
  const std::scoped_lock lock(tracking_mutex_, estimation_mutex_);
  registration_.restart({estimator, &estimator->model()});
  // From here nothing throws.
  parameters_ = parameters;
  updater_.replaceEstimator(estimator, keeps_inputs);
  comparison_.replaceFilter(std::move(contact));
}

bool StiffnessNode::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  setParameters(parameters_, false);
  response.success = true;
  response.message = "estimate, tip wrench, contact and the past for ~register are forgotten";
  ROS_INFO_STREAM("reset: " << response.message);
  return true;
}

bool StiffnessNode::pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  const Lock lock(estimation_mutex_);
  updater_.setPaused(request.data);
  response.success = true;
  response.message = request.data ? "paused: the last estimate is published as stale" : "continues with the next pressures";
  ROS_INFO_STREAM("pause: " << response.message);
  return true;
}

bool StiffnessNode::reload(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  try {
    const NodeParameters read = loadNodeParameters(private_node_);
    NodeParameters parameters = parameters_;  // topics, frames, times and the registration in use stay
    parameters.scene = read.scene;
    parameters.channel_of_chamber = read.channel_of_chamber;
    parameters.model = read.model;
    parameters.estimator = read.estimator;
    parameters.contact = read.contact;
    StiffnessConfig config = config_;
    config.__fromServer__(private_node_);
    parameters = reconfigured(parameters, config);
    setParameters(parameters, true);
    config_ = config;
    config_server_.updateConfig(config_);
    response.success = true;
    response.message = "loaded: " + std::to_string(parameters.scene.segmentCount()) + " segment(s), " +
                       std::to_string(parameters.scene.chamberCount()) + " chamber(s)";
    ROS_INFO_STREAM("reload: " << response.message);
  } catch (const ConfigurationError& error) {
    response.message = "kept what was loaded before: " + oneLine(error.faults());
    ROS_ERROR_STREAM("reload: " << response.message);
  }
  return true;
}

void StiffnessNode::reconfigure(StiffnessConfig& wanted, uint32_t level) {
  if (level == ~0u) return;  // the first call: what was loaded at start
  NodeParameters parameters;
  std::unique_ptr<TipWrenchEstimator> contact;  // another one, if it alone changes
  try {
    parameters = reconfigured(parameters_, wanted);
    if (level & Live::kRobot) setParameters(parameters, true);
    else if (level & Live::kContact)
      contact = std::make_unique<TipWrenchEstimator>(parameters.scene, parameters.model, parameters.contact);
  } catch (const ConfigurationError& error) {
    ROS_ERROR_STREAM("reconfigure: kept what was set before: " << oneLine(error.faults()));
    wanted = config_;
    return;
  }
  const std::scoped_lock lock(tracking_mutex_, estimation_mutex_);
  parameters_ = parameters;
  if (contact) comparison_.replaceFilter(std::move(contact));
  config_ = wanted;
}

}  // namespace live_stiffness
