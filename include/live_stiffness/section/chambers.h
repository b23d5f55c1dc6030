#pragma once
// Pressure chambers of one segment: where they sit in the section, and the wrench that their pressures exert.

#include <vector>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

// Parallel circular chambers on one pitch circle. Shi et al. section 3.2.
// The braid keeps the chamber radius r_P; the pitch radius shrinks with the section, as 1/sqrt(stretch).
struct Chambers {
  double radius = 0.0;           // r_P, m
  double pitch_radius = 0.0;     // r_o at stretch 1, m
  std::vector<double> azimuths;  // phi_k from the x towards the y axis of the section, rad; one per chamber

  int count() const { return static_cast<int>(azimuths.size()); }
  double area() const { return kPi * radius * radius; }  // A_P of one chamber, m^2

  // Centre d_k of chamber k in section axes at the given stretch (23), m.
  Vector3 centre(int k, double stretch) const;

  // F_P = sum_k P_k A_P, along e3 of the section (N). pressures: gauge, Pa, one per chamber.
  double actuationForce(PressuresRef pressures) const;

  // T_P = sum_k d_k x (P_k A_P e3) in section axes (N m), with d_k at the given stretch. Its z is zero.
  Vector3 actuationMoment(PressuresRef pressures, double stretch) const;
};

}  // namespace live_stiffness
