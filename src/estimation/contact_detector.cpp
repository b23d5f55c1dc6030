#include "live_stiffness/estimation/contact_detector.h"

#include <algorithm>

namespace live_stiffness {

void ContactThresholds::check(FaultList& faults) const {
  faults.check("contact.on_force_n", on_force, {1e-4, 1e3});
  faults.check("contact.off_force_n", off_force, {0.0, on_force});
  faults.check("contact.on_sigmas", on_sigmas, {0.0, 100.0});
  faults.check("contact.off_sigmas", off_sigmas, {0.0, on_sigmas});
  faults.check("contact.on_time_s", on_time, {0.0, 60.0});
  faults.check("contact.off_time_s", off_time, {0.0, 60.0});
}

bool ContactDetector::update(double force, double deviation, double elapsed) {
  const bool above = force > thresholds_.on_force && force > thresholds_.on_sigmas * deviation;
  const bool below = force < thresholds_.off_force || force < thresholds_.off_sigmas * deviation;
  if (contact_ ? !below : !above) {
    pending_ = 0.0;
    return contact_;
  }
  pending_ += elapsed;
  constexpr double kRounding = 1e-9;  // of sums of sample times, s
  if (pending_ >= (contact_ ? thresholds_.off_time : thresholds_.on_time) - kRounding) {
    contact_ = !contact_;
    pending_ = 0.0;
  }
  return contact_;
}

void ContactDetector::reset() {
  contact_ = false;
  pending_ = 0.0;
}

}  // namespace live_stiffness
