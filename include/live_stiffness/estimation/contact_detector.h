#pragma once
// Contact or not, from an estimated force: hysteresis in newtons, in standard deviations and in time.

#include "live_stiffness/checks.h"

namespace live_stiffness {

struct ContactThresholds {
  double on_force = 0.10;   // N; 1e-4 to 1e3
  double off_force = 0.06;  // N; 0 to on_force
  double on_sigmas = 3.0;   // of the estimate's own standard deviation; 0 to 100
  double off_sigmas = 1.0;  // 0 to on_sigmas
  double on_time = 0.1;     // s that the force must stay above on; 0 to 60
  double off_time = 0.3;    // s that it must stay below off; 0 to 60

  void check(FaultList& faults) const;  // names contact.on_force_n, ...
};

class ContactDetector {
 public:
  explicit ContactDetector(ContactThresholds thresholds) : thresholds_(thresholds) {}

  // force: magnitude, N; deviation: its standard deviation, N; elapsed: s since the last call. Contact begins when the
  // force has been above both on thresholds for on_time, and ends when it has been below either off threshold for
  // off_time. Returns inContact().
  bool update(double force, double deviation, double elapsed);

  bool inContact() const { return contact_; }
  void reset();

 private:
  ContactThresholds thresholds_;
  bool contact_ = false;
  double pending_ = 0.0;  // s that the force has asked for a change
};

}  // namespace live_stiffness
