#pragma once
// Load stepping (2.3): from chamber pressures to the rest strain of a segment, with the section updated as it
// stretches.
//
// T is double, or a type that carries derivatives (definitions: src/section/load_stepping_code.h).

#include "live_stiffness/section/stepping.h"
#include "section/section_moments.h"

namespace live_stiffness {

// A segment under its own pressures and no external load. Because every path starts at zero pressure it depends on
// the pressures alone, whatever the material.
template <class T>
struct RestStateOf {
  T stretch = T(1.0);                                             // lam, -
  Vector3Of<T> curvature = Vector3Of<T>::Constant(T(0.0));  // u_rest, 1/m of stretched length, in section axes
  ComplianceDensityOf<T> c;                                       // at the section this state ends with
  bool valid = true;  // false: at `stretch`, the last one reached, the section has no positive area or stiffness; then
                      // nothing else holds
};
using RestState = RestStateOf<double>;

// Number of fixed steps for the largest pressure magnitude of the whole robot: max(1, ceil(max |P| / pressure_step)).
// A quotient within 1e-9 of a whole number counts as that number, so that 1.2 bar, printed and read back, is still 8 steps.
int stepCount(double largest_pressure, double pressure_step);

// Load stepping of one segment; what depends on the section only is computed once.
template <class T>
class LoadStepperOf {
 public:
  explicit LoadStepperOf(const CrossSectionOf<T>& section);

  int chamberCount() const { return static_cast<int>(wrench_of_pressures_.cols()); }

  // Rest state under gauge pressures, Pa, one per chamber. steps: used by kFixedStep only.
  RestStateOf<T> restState(PressuresRefOf<T> pressures, Stepping stepping, int steps) const;

 private:
  // All of the pressures: F_P, T_P at stretch 1, and what they add to the stiffness.
  struct Actuation {
    T force = T(0.0);
    Vector2Of<T> moment = Vector2Of<T>::Constant(T(0.0));
    ChamberStiffnessOf<T> stiffness;
    ChamberStiffnessOf<T> share(double share) const {
      return {T(stiffness.axial * share), Matrix2Of<T>(stiffness.bending * T(share))};
    }
  };

  Actuation actuation(PressuresRefOf<T> pressures) const;
  RestStateOf<T> fixedSteps(const Actuation& on, int steps) const;
  RestStateOf<T> fixedMaterialSteps(const Actuation& on, int steps) const;
  RestStateOf<T> linearStep(const Actuation& on) const;
  RestStateOf<T> continuousSteps(const Actuation& on) const;
  RestStateOf<T> continuousMaterialSteps(const Actuation& on) const;

  SectionMomentsOf<T> section_;
  T area_growth_;  // of the chambers, 1/Pa
  Eigen::Matrix<T, 3, Eigen::Dynamic> wrench_of_pressures_;  // rows F_P (along e3), T_P x and y at stretch 1; one
                                                             // column per chamber
  Eigen::Matrix<T, 4, Eigen::Dynamic> stiffness_of_pressures_;  // rows axial, bending xx, xy, yy; empty when b = 0
};
using LoadStepper = LoadStepperOf<double>;

}  // namespace live_stiffness
