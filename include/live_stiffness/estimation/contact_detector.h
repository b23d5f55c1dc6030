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
  bool update(double force, double deviation, double elapsed);

  bool inContact() const { return contact_; }
  void reset();

 private:
  double on_force_;
  bool contact_ = false;
  double pending_ = 0.0;  // s that the force has asked for a change
};

}  // namespace live_stiffness
