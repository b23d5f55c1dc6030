#include "ros/contact_parameters.h"

#include <cmath>

namespace live_stiffness {

std::vector<ContactParameter> contactParameters(TipWrenchOptions& o) {
  const double degree = radians(1.0);
  return {{"tracker_position_noise_m", &o.tracker.position, {1e-6, 0.1}},
          {"tracker_rotation_noise_deg", &o.tracker.rotation, {1e-3, 57.0}, degree},
          {"free_force_n", &o.free_force, {1e-4, 100.0}},
          {"free_moment_n_m", &o.free_moment, {1e-6, 10.0}},
          {"free_time_s", &o.free_time, {0.01, 100.0}},
          {"contact_force_n", &o.contact_force, {1e-3, 1e4}},
          {"contact_moment_n_m", &o.contact_moment, {1e-5, 1e3}},
          {"force_walk_n_per_sqrt_s", &o.force_walk, {1e-3, 1e3}},
          {"moment_walk_n_m_per_sqrt_s", &o.moment_walk, {1e-5, 100.0}},
          {"model_error_position_m", &o.bias_position, {0.0, 0.1}},
          {"model_error_rotation_deg", &o.bias_rotation, {0.0, 57.0}, degree},
          {"model_error_time_s", &o.bias_time, {0.1, 1e5}},
          {"model_error_time_in_contact_s", &o.bias_time_in_contact, {0.1, 1e5}},
          {"model_error_position_m_per_pa", &o.bias_position_per_pressure, {0.0, 1e-5}},
          {"model_error_rotation_deg_per_pa", &o.bias_rotation_per_pressure, {0.0, 0.5}, degree},
          {"stiffness_scale_deviation", &o.scale_deviation, {0.0, 1.0}},
          {"stiffness_scale_walk_per_sqrt_s", &o.scale_walk, {0.0, 1.0}},
          {"robust_from_sigmas", &o.robust_from, {1.0, 100.0}},
          {"gate_sigmas", &o.gate, {1.0, 1000.0}, 1.0, &o.robust_from},
          {"contact_on_force_n", &o.contact.on_force, {1e-4, 1e3}},
          {"contact_off_force_n", &o.contact.off_force, {0.0, 1e3}, 1.0, nullptr, &o.contact.on_force},
          {"contact_on_sigmas", &o.contact.on_sigmas, {0.0, 100.0}},
          {"contact_off_sigmas", &o.contact.off_sigmas, {0.0, 100.0}, 1.0, nullptr, &o.contact.on_sigmas},
          {"contact_on_time_s", &o.contact.on_time, {0.0, 60.0}},
          {"contact_off_time_s", &o.contact.off_time, {0.0, 60.0}}};
}

TipWrenchOptions readContactParameters(ParameterReader& read, FaultList& faults) {
  TipWrenchOptions options;
  for (const ContactParameter& parameter : contactParameters(options)) {
    Range range = parameter.range;
    if (parameter.low != nullptr) range.low = *parameter.low / parameter.factor;
    if (parameter.high != nullptr) range.high = *parameter.high / parameter.factor;
    *parameter.value = parameter.factor * read.number(parameter.key, *parameter.value / parameter.factor, range);
  }
  const double components = read.number("wrench_components", options.components, {3.0, 6.0});
  if (components != 3.0 && components != 6.0)
    faults.add("~wrench_components = " + numberText(components) + ": must be 3 (a force) or 6 (force and moment)");
  options.components = static_cast<int>(components);
  const double reaccept = read.number("reaccept_samples", options.reaccept, {2.0, 1000.0});
  if (reaccept != std::floor(reaccept))
    faults.add("~reaccept_samples = " + numberText(reaccept) + ": must be a whole number");
  options.reaccept = static_cast<int>(reaccept);
  return options;
}

}  // namespace live_stiffness
