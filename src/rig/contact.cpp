#include "rig/contact.h"

#include <cmath>

#include "live_stiffness/lie/se3.h"
#include "rig/quintic_blend.h"

namespace live_stiffness {

Contact::Contact(const ContactOptions& options) : options_(options) {
  FaultList faults("contact");
  check(options, faults);
  faults.throwIfAny();
}

void Contact::check(const ContactOptions& options, FaultList& faults) {
  const auto check_axis = [&](const std::string& name, double value) { faults.check(name, value, Range::finite()); };
  for (int k = 0; k < 3; ++k) {
    check_axis("contact_force_n[" + std::to_string(k) + "]", options.wrench[k]);
    check_axis("contact_moment_n_m[" + std::to_string(k) + "]", options.wrench[3 + k]);
  }
  faults.check("contact_start_s", options.start, {0.0, 1e5});
  faults.check("contact_duration_s", options.duration, {0.1, 3600.0});
  faults.check("contact_ramp_s", options.ramp, {0.0, 0.5 * options.duration});
  if (options.period != 0.0) faults.check("contact_period_s", options.period, {options.duration, 1e5});
  faults.check("contact_turn_deg", degrees(options.turn), Range::finite());
}

Wrench Contact::at(double time) const {
  const double since = time - options_.start;
  if (since < 0.0 || !exists()) return Wrench::Zero();
  const double push = options_.period > 0.0 ? std::floor(since / options_.period) : 0.0;
  const double into = since - push * options_.period, left = options_.duration - into;
  if (left <= 0.0) return Wrench::Zero();
  const double height = options_.ramp > 0.0 ? quinticBlend(std::min(into, left) / options_.ramp) : 1.0;
  const Matrix3 turn = expSo3(Vector3(0.0, 0.0, std::remainder(push * options_.turn, 2.0 * kPi)));
  return height * (wrenchAdjoint({turn, Vector3::Zero()}) * options_.wrench);
}

}  // namespace live_stiffness
