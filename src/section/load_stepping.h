#pragma once
// Load stepping (2.3): from chamber pressures to the rest strain of a segment, with the section updated as it
// stretches.

#include "live_stiffness/section/stepping.h"
#include "section/section_moments.h"

namespace live_stiffness {

// A segment under its own pressures and no external load. Because every path starts at zero pressure it depends on
// the pressures alone, whatever the material.
struct RestState {
  double stretch = 1.0;                  // lam, -
  Vector3 curvature = Vector3::Zero();  // u_rest, 1/m of stretched length, in section axes
  ComplianceDensity c;                   // at the section this state ends with
  bool valid = true;  // false: at `stretch`, the last one reached, the section has no positive area or stiffness; then
                      // nothing else holds
};

// Number of fixed steps for the largest pressure magnitude of the whole robot: max(1, ceil(max |P| / pressure_step)).
// A quotient within 1e-9 of a whole number counts as that number, so that 1.2 bar, printed and read back, is still 8 steps.
int stepCount(double largest_pressure, double pressure_step);

// Load stepping of one segment; what depends on the section only is computed once.
class LoadStepper {
 public:
  explicit LoadStepper(const CrossSection& section);

  int chamberCount() const { return static_cast<int>(wrench_of_pressures_.cols()); }

  // Rest state under gauge pressures, Pa, one per chamber. steps: used by kFixedStep only.
  RestState restState(PressuresRef pressures, Stepping stepping, int steps) const;

 private:
  // All of the pressures: F_P, T_P at stretch 1, and what they add to the stiffness.
  struct Actuation {
    double force = 0.0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    ChamberStiffness stiffness;
    ChamberStiffness share(double share) const {
      return {share * stiffness.axial, share * stiffness.bending};
    }
  };

  Actuation actuation(PressuresRef pressures) const;
  RestState fixedSteps(const Actuation& on, int steps) const;
  RestState fixedMaterialSteps(const Actuation& on, int steps) const;
  RestState linearStep(const Actuation& on) const;
  RestState continuousSteps(const Actuation& on) const;
  RestState continuousMaterialSteps(const Actuation& on) const;

  SectionMoments section_;
  double area_growth_;  // of the chambers, 1/Pa
  Eigen::Matrix<double, 3, Eigen::Dynamic> wrench_of_pressures_;  // rows F_P (along e3), T_P x and y at stretch 1; one
                                                             // column per chamber
  Eigen::Matrix<double, 4, Eigen::Dynamic> stiffness_of_pressures_;  // rows axial, bending xx, xy, yy; empty when b = 0
};

}  // namespace live_stiffness
