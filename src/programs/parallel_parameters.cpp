#include "programs/parallel_parameters.h"

#include <ros/console.h>

#include "live_stiffness/parallel/parallel_scene_file.h"
#include "ros/parameter_reader.h"

namespace live_stiffness {

ParallelParameters loadParallelParameters(const ros::NodeHandle& private_node) {
  FaultList faults("parameters of " + private_node.getNamespace());
  ParameterReader read(private_node, faults);
  ParallelParameters parameters;
  parameters.scene = read.file<ParallelScene>("scene_file", loadParallelSceneFile, true);
  parameters.model.accuracy = read.number("accuracy", parameters.model.accuracy, {1e-13, 1e-2});
  parameters.length_unit = read.choice("length_unit", "m", {"m", "mm"}) == "mm" ? 1e-3 : 1.0;
  parameters.length_timeout = read.number("length_timeout_s", parameters.length_timeout, Range::positive());
  parameters.wrench_timeout =
      read.number("platform_wrench_timeout_s", parameters.wrench_timeout, Range::nonnegative());
  parameters.heartbeat = read.number("heartbeat_hz", parameters.heartbeat, {0.1, 1000.0});
  readFrames(read, "platform_frame", "platform", parameters.frames, faults);
  ParallelMarkerStyle& style = parameters.style;
  style.frame = parameters.frames.base;
  style.ellipsoid_scale = read.number("ellipsoid_scale_m_per_m_n", style.ellipsoid_scale, Range::positive());
  style.rotation_scale = read.number("rotation_ellipsoid_scale_m_per_rad_n_m", style.rotation_scale, Range::positive());
  parameters.marker_rate = read.number("marker_rate_hz", parameters.marker_rate, {0.1, 100.0});
  for (const std::string& key : read.unknown()) ROS_WARN("parameter ~%s is not known to parallel_node", key.c_str());
  faults.throwIfAny();
  return parameters;
}

}  // namespace live_stiffness
