#pragma once
// Pressure chambers of one segment: where they are in the section, and the wrench that their pressures exert.

#include <cmath>
#include <vector>

#include "live_stiffness/conventions.h"

namespace live_stiffness {


// Parallel circular chambers on one pitch circle. Shi et al. section 3.2.
// The braid keeps the chamber radius r_P; the pitch radius shrinks with the section, as 1/sqrt(stretch).
struct Chambers {
  double radius = 0.0;           // r_P, m
  double pitch_radius = 0.0;     // r_o at stretch 1, m
  std::vector<double> azimuths;  // phi_k from the x towards the y axis of the section, rad; one per chamber
  // gamma, 1/Pa: a chamber swells under its pressure and pushes on the area A_P (1 + gamma P). 0: the braid prevents
  // this, as in the paper. Below 1 / (2 atm), so that the force grows with the pressure everywhere, from vacuum up.
  double area_growth = 0.0;

  int count() const { return static_cast<int>(azimuths.size()); }
  double area() const { return kPi * radius * radius; }  // A_P of one chamber without pressure, m^2

  // Pressure on A_P that gives the same force: P (1 + gamma P), Pa.
  double effectivePressure(double pressure) const { return pressure + area_growth * pressure * pressure; }

  // Centre d_k of chamber k in section axes at the given stretch (23), m.
  Vector3 centre(int k, double stretch) const {
    const double r = pitch_radius / std::sqrt(stretch);
    return {r * std::cos(azimuths[k]), r * std::sin(azimuths[k]), 0.0};
  }

  // F_P = sum_k P_k A_P (P_k the effective pressure), along e3 of the section (N). pressures: gauge, Pa, one per chamber.
  double actuationForce(PressuresRef pressures) const {
    double sum = 0.0;
    for (int k = 0; k < count(); ++k) sum += effectivePressure(pressures[k]);
    return area() * sum;
  }

  // T_P = sum_k d_k x (P_k A_P e3) in section axes (N m), with d_k at the given stretch. Its z is zero.
  Vector3 actuationMoment(PressuresRef pressures, double stretch) const {
    Vector3 moment = Vector3::Zero();
    for (int k = 0; k < count(); ++k) {
      const Vector3 d = centre(k, stretch);
      const double force = effectivePressure(pressures[k]) * area();
      moment += Vector3(force * d.y(), -force * d.x(), 0.0);  // d x e3
    }
    return moment;
  }
};

}  // namespace live_stiffness
