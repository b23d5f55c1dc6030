#include "rig_parameters.h"

#include "live_stiffness/rod/scene_file.h"
#include "ros/parameter_reader.h"

namespace live_stiffness {
namespace {

Vector3 readVector3(ParameterReader& read, const NumbersParameter& parameter, FaultList& faults) {
  std::vector<double> values = parameter.standard;
  read(parameter, values);
  if (values.size() == 3) return {values[0], values[1], values[2]};
  faults.add(parameter.key + (" has " + std::to_string(values.size())) + " entries: must have three, x, y and z");
  return Vector3::Zero();
}

}  // namespace

RigParameters loadRigParameters(const ros::NodeHandle& private_node) {
  FaultList faults("parameters of " + private_node.getNamespace(), "~");
  ParameterReader read(private_node, faults);
  RigParameters parameters;
  RigOptions& options = parameters.options;
  std::string program = kProgram.standard;
  read(kProgram, program);
  RigOptions::forEachParameter(options, read);
  ContactOptions::forEachParameter(options.contact, read);
  options.contact.wrench << readVector3(read, kPushForce, faults), readVector3(read, kPushMoment, faults);
  read(kSampleRate, parameters.rate);
  read(kRigTrackerFrame, parameters.tracker_frame);
  read(kRigBaseFrame, parameters.base_frame);
  read.requiredFile(kSceneFile, loadSceneFile, parameters.scene);
  read.file(kRigRegistrationFile, loadRegistrationFile, options.registration);
  read.warnOfUnknown("rig_simulator");
  options.program.kind = programKind(program, faults);
  faults.check(kSampleRate, parameters.rate);
  faults.checkAll(options);
  Contact::check(options.contact, faults);
  faults.throwIfAny();
  return parameters;
}

}  // namespace live_stiffness
