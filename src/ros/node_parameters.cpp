#include "ros/node_parameters.h"

#include <ros/console.h>

#include "live_stiffness/rod/scene_file.h"
#include "ros/contact_parameters.h"
#include "ros/parameter_reader.h"

namespace live_stiffness {
namespace {

constexpr double kMinStep = 100.0, kMaxStep = 1e7;  // Pa

void readModel(ParameterReader& read, NodeParameters& parameters, FaultList& faults) {
  FaultList names("model");
  const std::string model = read.text("model", "ncm");
  parameters.model = namedModelOptions(model, read.text("stepping", ""), names);
  for (const std::string& fault : names.faults()) faults.add("~" + fault);
  parameters.model.pressure_step =
      read.number("pressure_step_pa", parameters.model.pressure_step, {kMinStep, kMaxStep});
  parameters.model.accuracy = read.number("accuracy", parameters.model.accuracy, {1e-13, 1e-2});
  parameters.estimator.update_threshold =
      read.number("update_threshold_pa", parameters.estimator.update_threshold, {0.0, 1e8});
  parameters.heartbeat = read.number("heartbeat_hz", parameters.heartbeat, {0.1, 1000.0});
}

void readPressureInput(ParameterReader& read, NodeParameters& parameters, FaultList& faults) {
  PressureFormat& format = parameters.pressure_format;
  format.unit = pascalsPerUnit(read.choice("pressure_unit", "Pa", {"Pa", "kPa", "bar", "mbar", "psi"}));
  format.absolute = read.choice("pressure_reference", "gauge", {"gauge", "absolute"}) == "absolute";
  format.atmosphere = read.number("atmospheric_pressure_pa", format.atmosphere, {50e3, 120e3});
  parameters.pressure_topics = read.texts("pressure_topics");
  for (const std::string& topic : parameters.pressure_topics) {
    std::string reason;
    if (!ros::names::validate(topic, reason) || topic.empty())
      faults.add("~pressure_topics: " + topic + " is no topic name: " + reason);
  }
  parameters.channel_of_chamber = read.indices("channel_of_chamber");
  parameters.pressure_timeout = read.number("pressure_timeout_s", parameters.pressure_timeout, Range::positive());
}

void readTracker(ParameterReader& read, NodeParameters& parameters) {
  parameters.position_unit = read.choice("aurora_position_unit", "m", {"m", "mm"}) == "mm" ? 1e-3 : 1.0;
  parameters.tracker_frame = withoutSlash(read.text("tracker_frame", "aurora"));
  parameters.sensor_frame = withoutSlash(read.text("sensor_frame", "aurora_tip"));
  parameters.tracker_tf_frame = withoutSlash(read.text("aurora_tf_frame", ""));
  parameters.pose_timeout = read.number("pose_timeout_s", parameters.pose_timeout, Range::positive());
  parameters.tip_wrench_timeout =
      read.number("tip_wrench_timeout_s", parameters.tip_wrench_timeout, Range::nonnegative());
  parameters.registration = read.file<Registration>("registration_file", loadRegistrationFile, false);
  parameters.registration_file = read.text("registration_file", "");
  parameters.registration_buffer = read.number("registration_buffer_s", parameters.registration_buffer, {1.0, 3600.0});
}

void readDisplay(ParameterReader& read, NodeParameters& parameters, FaultList& faults) {
  readFrames(read, "tip_frame", "tip", parameters.frames, faults);
  parameters.estimator.fractions =
      read.numbers("ellipsoid_fractions", parameters.estimator.fractions, {0.0, 1.0});
  parameters.style.frame = parameters.frames.base;
  double& ellipsoid_scale = parameters.style.ellipsoid_scale;
  ellipsoid_scale = read.number("ellipsoid_scale_m_per_m_n", ellipsoid_scale, {1e-6, 1e6});
  parameters.contact_arrow_scale =
      read.number("contact_arrow_n_per_m", parameters.contact_arrow_scale, {1e-6, 1e6});
  parameters.marker_rate = read.number("marker_rate_hz", parameters.marker_rate, {0.1, 100.0});
  parameters.show_eigenscrews = read.boolean("show_eigenscrews", parameters.show_eigenscrews);
  parameters.eigenscrew_length =
      read.number("eigenscrew_length_m", parameters.eigenscrew_length, {1e-4, 100.0});
  TipHandleOptions& handle = parameters.tip_handle;
  handle.enabled = read.boolean("tip_handle", handle.enabled);
  handle.force_per_m = read.number("tip_handle_force_n_per_m", handle.force_per_m, Range::positive());
  handle.moment_per_rad = read.number("tip_handle_moment_n_m_per_rad", handle.moment_per_rad, Range::positive());
}

void readScene(ParameterReader& read, NodeParameters& parameters, FaultList& faults) {
  parameters.scene = read.file<Scene>("scene_file", loadSceneFile, true);
  const int chambers = parameters.scene.chamberCount();
  const size_t mapped = parameters.channel_of_chamber.size();
  if (chambers > 0 && mapped != 0 && mapped != static_cast<size_t>(chambers))
    faults.add("~channel_of_chamber has " + std::to_string(mapped) + " entries: must have one for each of the scene's " +
               std::to_string(chambers) + " chambers, or be empty");
}

}  // namespace

NodeParameters loadNodeParameters(const ros::NodeHandle& private_node) {
  FaultList faults("parameters of " + private_node.getNamespace());
  ParameterReader read(private_node, faults);
  NodeParameters parameters;
  readModel(read, parameters, faults);
  readPressureInput(read, parameters, faults);
  readTracker(read, parameters);
  parameters.contact = readContactParameters(read, faults);
  readDisplay(read, parameters, faults);
  readScene(read, parameters, faults);
  for (const std::string& key : read.unknown()) ROS_WARN("parameter ~%s is not known to stiffness_node", key.c_str());
  faults.throwIfAny();
  return parameters;
}

}  // namespace live_stiffness
