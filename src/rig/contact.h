#pragma once
// A pusher that touches the tip of the simulated robot at programmed times, with a programmed force: a truth for
// estimators of contact.

#include "rig/parameters.h"

namespace live_stiffness {

struct Contact {
  Wrench wrench = Wrench::Zero();  // of the first push at its height: [f; m] at T, base axes, N and N m; finite.
                                   // Zero: nothing ever touches the tip
  double start = kPushStart.standard;        // when the first push begins, s
  double duration = kPushDuration.standard;  // of a push, rise and fall included, s
  double ramp = kPushRamp.standard;          // of the rise and of the fall, s; at most half of the duration
  double period = kPushPeriod.standard;      // from one push's beginning to the next one's, s; at least the duration.
                                             // 0: one push only
  double turn = kPushTurn.si();              // of the wrench about z of the base from push to push, rad

  // Of all but the wrench.
  template <class Options, class Visit>
  static void forEachParameter(Options& options, Visit&& visit) {
    visit(kPushStart, options.start);
    visit(kPushDuration, options.duration);
    visit(kPushRamp, options.ramp);
    visit(kPushPeriod, options.period);
    visit(kPushTurn, options.turn);
  }
  // Adds the faults of the wrench, and of numbers that do not fit together.
  void check(FaultList& faults) const;

  // True if the pusher ever touches the tip.
  bool exists() const { return !wrench.isZero(0.0); }
  // Dead wrench at T, base axes, at a time (s, finite); zero between pushes and before the first. Rise and fall are quintic
  // blends.
  Wrench at(double time) const;
};

}  // namespace live_stiffness
