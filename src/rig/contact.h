#pragma once
// A pusher that touches the tip of the simulated robot at programmed times, with a programmed force: a truth for
// estimators of contact.

#include "live_stiffness/checks.h"
#include "live_stiffness/conventions.h"

namespace live_stiffness {

// Legal ranges in the comments. The names of the parameter files are contact_ and these with their units.
struct ContactOptions {
  Wrench wrench = Wrench::Zero();  // of the first push at its height: [f; m] at T, base axes, N and N m; finite.
                                   // Zero: nothing ever touches the tip
  double start = 5.0;              // when the first push begins, s; 0 to 1e5
  double duration = 4.0;           // of a push, rise and fall included, s; 0.1 to 3600
  double ramp = 0.5;               // of the rise and of the fall, s; 0 to half of the duration
  double period = 10.0;            // from one push's beginning to the next one's, s; duration to 1e5. 0: one push only
  double turn = radians(90.0);     // of the wrench about z of the base from push to push, rad; finite
};

// A pure function of time. Rise and fall are quintic blends.
class Contact {
 public:
  // Throws ConfigurationError with every fault.
  explicit Contact(const ContactOptions& options);

  // Adds faults of options to a list.
  static void check(const ContactOptions& options, FaultList& faults);

  // True if the pusher ever touches the tip.
  bool exists() const { return !options_.wrench.isZero(0.0); }
  // Dead wrench at T, base axes, at a time (s, finite); zero between pushes and before the first.
  Wrench at(double time) const;

 private:
  ContactOptions options_;
};

}  // namespace live_stiffness
