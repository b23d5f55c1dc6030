// What changes a running StiffnessNode: ~reset, ~pause, ~reload and dynamic_reconfigure.

#include "ros/stiffness_node.h"

namespace live_stiffness {
namespace {

std::string joined(const std::vector<std::string>& faults) {
  std::string text;
  for (const std::string& fault : faults) text += (text.empty() ? "" : "; ") + fault;
  return text;
}

}  // namespace

void StiffnessNode::addServices() {
  servers_ = {private_node_.advertiseService("reset", &StiffnessNode::reset, this),
              private_node_.advertiseService("pause", &StiffnessNode::pause, this),
              private_node_.advertiseService("reload", &StiffnessNode::reload, this)};
  reconfiguration_ = std::make_unique<dynamic_reconfigure::Server<StiffnessConfig>>(private_node_);
  reconfiguration_->getConfigDefault(config_);
  config_.__fromServer__(private_node_);  // the parameters were loaded from there
  reconfiguration_->setCallback([this](StiffnessConfig& config, uint32_t level) { onReconfigure(config, level); });
}

void StiffnessNode::renew(const NodeParameters& parameters, bool keeps_inputs) {
  const auto estimator = std::make_shared<StiffnessEstimator>(parameters.scene, parameters.model, parameters.estimator);
  auto contact = std::make_unique<TipWrenchEstimator>(parameters.scene, parameters.model, parameters.contact);
  const std::shared_ptr<const StiffnessModel> model(estimator, &estimator->model());
  const std::scoped_lock lock(tracking_.mutex(), live_.mutex());
  const bool is_same_robot = parameters.scene.chamberCount() == parameters_.scene.chamberCount();
  parameters_ = parameters;
  const Pressures pressures = estimator_->pressures();
  if (keeps_inputs) estimator->setTipWrench(estimator_->tipWrench());
  estimator_ = estimator;
  history_.clear();
  contact_.adopt(std::move(contact));
  pressure_input_.adapt();
  if (!keeps_inputs || !is_same_robot) estimate_stamp_ = ros::Time();
  else if (pressures.size() > 0) react(estimator_->setPressures(pressures, pressure_stamp_.toSec()));
}

bool StiffnessNode::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  renew(parameters_, false);
  registration_.restart(newest().model);
  response.success = true;
  response.message = "estimate, tip wrench, contact and the past for ~register are forgotten";
  ROS_INFO_STREAM("reset: " << response.message);
  return true;
}

bool StiffnessNode::pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  const Lock lock(live_.mutex());
  is_paused_ = request.data;
  publishEstimate();
  response.success = true;
  response.message = is_paused_ ? "paused: the last estimate goes on, marked stale" : "going on with the next pressures";
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
    renew(parameters, true);
    registration_.restart(newest().model);
    config_.__fromServer__(private_node_);
    reconfiguration_->updateConfig(config_);
    response.success = true;
    response.message = "loaded: " + std::to_string(parameters.scene.segmentCount()) + " segment(s), " +
                       std::to_string(parameters.scene.chamberCount()) + " chamber(s)";
    ROS_INFO_STREAM("reload: " << response.message);
  } catch (const ConfigurationError& error) {
    response.message = "kept what was loaded before: " + joined(error.faults());
    ROS_ERROR_STREAM("reload: " << response.message);
  }
  return true;
}

void StiffnessNode::onReconfigure(StiffnessConfig& config, uint32_t level) {
  if (level == ~0u) return;  // the first call: what was loaded at start
  NodeParameters parameters = parameters_;
  FaultList faults("reconfigure");
  apply(config, parameters, faults);
  try {
    faults.throwIfAny();
    if (level & (kContactChanged | kRobotChanged)) {
      renew(parameters, true);
      if (level & kRobotChanged) registration_.restart(newest().model);
    }
  } catch (const ConfigurationError& error) {
    ROS_ERROR_STREAM("reconfigure: kept what was set before: " << joined(error.faults()));
    config = config_;
    return;
  }
  const std::scoped_lock lock(tracking_.mutex(), live_.mutex());
  parameters_ = parameters;
  config_ = config;
}

}  // namespace live_stiffness
