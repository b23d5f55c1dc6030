#include "live_stiffness/estimation/contact_detector.h"

namespace live_stiffness {
namespace {

constexpr double kOffShare = 0.6;  // of on_force, where contact ends, so that a force at the threshold does not flicker
constexpr double kOnDeviations = 3.0, kOffDeviations = 1.0;  // so that an uncertain force is no contact
constexpr double kOnTime = 0.1, kOffTime = 0.3;              // s; longer than an outlier lasts

}  // namespace

bool ContactDetector::update(double force, double deviation, double elapsed) {
  const bool above = force > on_force_ && force > kOnDeviations * deviation;
  const bool below = force < kOffShare * on_force_ || force < kOffDeviations * deviation;
  if (contact_ ? !below : !above) {
    pending_ = 0.0;
    return contact_;
  }
  pending_ += elapsed;
  constexpr double kRounding = 1e-9;  // of sums of sample times, s
  if (pending_ >= (contact_ ? kOffTime : kOnTime) - kRounding) {
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
