#pragma once
// One segment under weight, a wrench at its tip and another at a section within: RK4 and Newton shooting with
// differences, on rotation matrices. Shares nothing with the library's elements but the rest state.

#include <vector>

#include "live_stiffness/lie/se3.h"
#include "rod/chain.h"
#include "section/load_stepping.h"

namespace live_stiffness {

struct PointLoadedRod {
  RestState rest;
  double length = 0.0;    // stretched, m
  double mass = 0.0;      // spread, kg
  double tip_mass = 0.0;
  DeadLoads loads;        // gravity and tip wrench

  // Poses after every one of `steps` steps, base first, with a wrench at the section after `at` steps (0 < at < steps).
  // Throws std::runtime_error unless the tip moment is met.
  std::vector<Pose> solve(int steps, int at, const Wrench& wrench) const;
};

}  // namespace live_stiffness
