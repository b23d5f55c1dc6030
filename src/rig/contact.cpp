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
  const Wrench& wrench = options.wrench;
  faults.check(kPushForce, std::vector<double>(wrench.data(), wrench.data() + 3));
  faults.check(kPushMoment, std::vector<double>(wrench.data() + 3, wrench.data() + 6));
  faults.checkAll(options);
  const std::string duration = "contact_duration_s, " + numberText(options.duration);
  if (options.ramp > 0.5 * options.duration)
    faults.add(kPushRamp.key + (" = " + numberText(options.ramp)) + ": must be at most half of " + duration);
  if (options.period != 0.0 && options.period < options.duration)
    faults.add(kPushPeriod.key + (" = " + numberText(options.period)) + ": must be 0 (one push) or at least " + duration);
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
