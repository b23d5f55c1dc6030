#pragma once
// Load stepping (2.3): from chamber pressures to the rest strain of a segment, with the section updated as it
// stretches.

#include "live_stiffness/section/cross_section.h"

namespace live_stiffness {

enum class Stepping {
  kFixedStep,   // (12): n equal steps along the straight path from zero pressure; the paper's NPCC and NCM
  kContinuous,  // limit n -> infinity, by quadrature: no step-size dependence
  kLinear,      // one step, the section never updated; the paper's LPCC and LCM
};

// A segment under its own pressures and no external load. Because every path starts at zero pressure it depends on
// the pressures alone.
struct RestState {
  double stretch = 1.0;                 // lam, -
  Vector3 curvature = Vector3::Zero();  // u_rest, 1/m of stretched length, in section axes
  ComplianceDensity c;                  // at the section this state ends with
  bool valid = true;  // false: the section has no positive area at `stretch`, the last one reached; nothing else holds
};

// Number of fixed steps for the largest pressure magnitude of the whole robot: max(1, ceil(max |P| / pressure_step)).
// A quotient within 1e-9 of a whole number counts as that number, so that 1.2 bar printed and read back stays 8 steps.
int stepCount(double largest_pressure, double pressure_step);

// Load stepping of one segment, with what it needs of the section worked out once.
class LoadStepper {
 public:
  explicit LoadStepper(const CrossSection& section);

  int chamberCount() const { return static_cast<int>(wrench_of_pressures_.cols()); }

  // Rest state under gauge pressures, Pa, one per chamber. steps: used by kFixedStep only.
  RestState restState(PressuresRef pressures, Stepping stepping, int steps) const;

 private:
  RestState fixedSteps(double force, const Eigen::Vector2d& moment, int steps) const;
  RestState linearStep(double force, const Eigen::Vector2d& moment) const;
  RestState continuousSteps(double force, const Eigen::Vector2d& moment) const;

  SectionMoments section_;
  Eigen::Matrix3Xd wrench_of_pressures_;  // rows F_P (along e3), T_P x and y at stretch 1; one column per chamber
};

// The same in one call.
RestState restState(const CrossSection& section, PressuresRef pressures, Stepping stepping, int steps);

}  // namespace live_stiffness
