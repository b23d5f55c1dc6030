#include "rig_parameters.h"

#include <ros/console.h>

#include "live_stiffness/rod/scene_file.h"
#include "ros/conversions.h"
#include "ros/parameter_reader.h"

namespace live_stiffness {

namespace {

Vector3 readVector3(ParameterReader& read, const std::string& key, FaultList& faults) {
  const std::vector<double> values = read.numbers(key, {0.0, 0.0, 0.0}, Range::finite());
  if (values.size() == 3) return {values[0], values[1], values[2]};
  faults.add("~" + key + " has " + std::to_string(values.size()) + " entries: must have three, x, y and z");
  return Vector3::Zero();
}

void readContact(ParameterReader& read, ContactOptions& contact, FaultList& faults) {
  contact.wrench << readVector3(read, "contact_force_n", faults), readVector3(read, "contact_moment_n_m", faults);
  contact.start = read.number("contact_start_s", contact.start, {0.0, 1e5});
  contact.duration = read.number("contact_duration_s", contact.duration, {0.1, 3600.0});
  contact.ramp = read.number("contact_ramp_s", contact.ramp, {0.0, 0.5 * contact.duration});
  contact.period = read.number("contact_period_s", contact.period, {0.0, 1e5});
  if (contact.period != 0.0 && contact.period < contact.duration)
    faults.add("~contact_period_s = " + numberText(contact.period) + ": must be 0 (one push) or at least "
               "contact_duration_s, " + numberText(contact.duration));
  contact.turn = radians(read.number("contact_turn_deg", degrees(contact.turn), {-360.0, 360.0}));
}

}  // namespace

RigParameters loadRigParameters(const ros::NodeHandle& private_node) {
  FaultList faults("parameters of " + private_node.getNamespace());
  ParameterReader read(private_node, faults);
  RigParameters parameters;
  RigOptions& options = parameters.options;
  parameters.scene = read.file<Scene>("scene_file", loadSceneFile, true);
  options.registration = read.file<Registration>("registration_file", loadRegistrationFile, false);
  options.channel_of_chamber = read.indices("channel_of_chamber");
  options.program.kind = programKind(read.choice("program", "triangle", {"triangle", "staircase", "random_walk"}), faults);
  options.program.amplitude = read.number("amplitude_pa", options.program.amplitude, {0.0, 1e6});
  options.program.period = read.number("period_s", options.program.period, {0.1, 3600.0});
  options.seed = static_cast<std::uint64_t>(read.number("seed", 1.0, {0.0, 1e9}));
  options.regulator_error = read.number("regulator_error_pa", options.regulator_error, {0.0, 1e5});
  options.regulator_time_constant = read.number("regulator_time_constant_s", options.regulator_time_constant, {0.0, 10.0});
  options.creep_fraction = read.number("creep_fraction", options.creep_fraction, {0.0, 0.5});
  options.creep_time_constant = read.number("creep_time_constant_s", options.creep_time_constant, {0.01, 1000.0});
  options.position_noise = read.number("position_noise_m", options.position_noise, {0.0, 0.1});
  options.rotation_noise = radians(read.number("rotation_noise_deg", degrees(options.rotation_noise), {0.0, 28.0}));
  options.drop_out_probability = read.number("drop_out_probability", options.drop_out_probability, {0.0, 1.0});
  options.drop_out_duration = read.number("drop_out_duration_s", options.drop_out_duration, {0.0, 3600.0});
  readContact(read, options.contact, faults);
  parameters.rate = read.number("rate_hz", parameters.rate, {1.0, 1000.0});
  parameters.tracker_frame = withoutSlash(read.text("tracker_frame", "aurora"));
  parameters.base_frame = withoutSlash(read.text("base_frame", "base"));
  for (const std::string& key : read.unknown()) ROS_WARN("parameter ~%s is not known to rig_simulator", key.c_str());
  faults.throwIfAny();
  return parameters;
}

}  // namespace live_stiffness
