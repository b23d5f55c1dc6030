#include "live_stiffness/estimation/tip_wrench_options.h"

namespace live_stiffness {

void TipWrenchOptions::check(FaultList& faults) const {
  if (components != 3 && components != 6)
    faults.add("components = " + std::to_string(components) + ": must be 3 (force) or 6 (force and moment)");
  faults.check("tracker.position", tracker.position, {1e-6, 0.1});
  faults.check("tracker.rotation", tracker.rotation, {1e-5, 1.0});
  faults.check("free_force", free_force, {1e-4, 100.0});
  faults.check("free_moment", free_moment, {1e-6, 10.0});
  faults.check("free_time", free_time, {0.01, 100.0});
  faults.check("contact_force", contact_force, {1e-3, 1e4});
  faults.check("contact_moment", contact_moment, {1e-5, 1e3});
  faults.check("force_walk", force_walk, {1e-3, 1e3});
  faults.check("moment_walk", moment_walk, {1e-5, 100.0});
  faults.check("bias_position", bias_position, {0.0, 0.1});
  faults.check("bias_rotation", bias_rotation, {0.0, 1.0});
  faults.check("bias_time", bias_time, {0.1, 1e5});
  faults.check("bias_time_in_contact", bias_time_in_contact, {0.1, 1e5});
  faults.check("bias_position_per_pressure", bias_position_per_pressure, {0.0, 1e-5});
  faults.check("bias_rotation_per_pressure", bias_rotation_per_pressure, {0.0, 1e-2});
  faults.check("scale_deviation", scale_deviation, {0.0, 1.0});
  faults.check("scale_walk", scale_walk, {0.0, 1.0});
  faults.check("robust_from", robust_from, {1.0, 100.0});
  faults.check("gate", gate, {robust_from, 1000.0});
  faults.check("reaccept", reaccept, {2.0, 1000.0});
  contact.check(faults);
}

}  // namespace live_stiffness
