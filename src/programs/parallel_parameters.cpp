#include "programs/parallel_parameters.h"

#include "live_stiffness/parallel/parallel_scene_file.h"
#include "ros/parameter_reader.h"

namespace live_stiffness {

ParallelParameters loadParallelParameters(const ros::NodeHandle& private_node) {
  FaultList faults("parameters of " + private_node.getNamespace(), "~");
  ParameterReader read(private_node, faults);
  ParallelParameters parameters;
  ParallelParameters::forEachParameter(parameters, read);
  read.requiredFile(kSceneFile, loadParallelSceneFile, parameters.scene);
  read.warnOfUnknown("parallel_node");
  faults.checkAll(parameters);
  checkFrames(parameters.frames, kPlatformFrame, faults);
  faults.throwIfAny();
  parameters.length_unit = parameters.length_unit_name == "mm" ? 1e-3 : 1.0;
  parameters.style.frame = parameters.frames.base;
  return parameters;
}

}  // namespace live_stiffness
