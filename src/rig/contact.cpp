#include "rig/contact.h"

#include <cmath>

#include "live_stiffness/lie/se3.h"
#include "rig/quintic_blend.h"

namespace live_stiffness {

void Contact::check(FaultList& faults) const {
  faults.check(kPushForce, std::vector<double>(wrench.data(), wrench.data() + 3));
  faults.check(kPushMoment, std::vector<double>(wrench.data() + 3, wrench.data() + 6));
  const std::string of_duration = "contact_duration_s, " + numberText(duration);
  if (ramp > 0.5 * duration)
    faults.add(kPushRamp.key + (" = " + numberText(ramp)) + ": must be at most half of " + of_duration);
  if (period != 0.0 && period < duration)
    faults.add(kPushPeriod.key + (" = " + numberText(period)) + ": must be 0 (one push) or at least " + of_duration);
}

Wrench Contact::at(double time) const {
  const double since = time - start;
  if (since < 0.0 || !exists()) return Wrench::Zero();
  const double push = period > 0.0 ? std::floor(since / period) : 0.0;
  const double into = since - push * period, left = duration - into;
  if (left <= 0.0) return Wrench::Zero();
  const double height = ramp > 0.0 ? quinticBlend(std::min(into, left) / ramp) : 1.0;
  const Matrix3 turned = expSo3(Vector3(0.0, 0.0, std::remainder(push * turn, 2.0 * kPi)));
  return height * (wrenchAdjoint({turned, Vector3::Zero()}) * wrench);
}

}  // namespace live_stiffness
