#pragma once
// Contact or not, from an estimated force: hysteresis in newtons, in standard deviations and in time.

namespace live_stiffness {

class ContactDetector {
 public:
  // on_force: above it contact begins, N.
  explicit ContactDetector(double on_force) : on_force_(on_force) {}

  // force: magnitude, N; deviation: its standard deviation, N; elapsed: s since the last call. Contact begins when the
  // force has been above on_force and well above its deviation for a while, and ends when it has been below 0.6
  // on_force, or within its deviation, for a little longer. Returns inContact().
  bool update(double force, double deviation, double elapsed) {
    constexpr double kOffShare = 0.6;  // of on_force, so that a force at the threshold does not flicker
    constexpr double kOnDeviations = 3.0, kOffDeviations = 1.0;  // so that an uncertain force is no contact
    constexpr double kOnTime = 0.1, kOffTime = 0.3;              // s; longer than an outlier lasts
    constexpr double kRounding = 1e-9;                           // of sums of sample times, s
    const bool above = force > on_force_ && force > kOnDeviations * deviation;
    const bool below = force < kOffShare * on_force_ || force < kOffDeviations * deviation;
    const bool asks_for_change = contact_ ? below : above;
    pending_ = asks_for_change ? pending_ + elapsed : 0.0;
    if (asks_for_change && pending_ >= (contact_ ? kOffTime : kOnTime) - kRounding) {
      contact_ = !contact_;
      pending_ = 0.0;
    }
    return contact_;
  }

  bool inContact() const { return contact_; }
  void reset() { *this = ContactDetector(on_force_); }

 private:
  double on_force_;
  bool contact_ = false;
  double pending_ = 0.0;  // s that the force has asked for a change
};

}  // namespace live_stiffness
