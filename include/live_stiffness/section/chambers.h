#pragma once
// Pressure chambers of one segment: where they are in the section, and the wrench that their pressures exert.
//
// T is double, or a type that carries derivatives.

#include <cmath>
#include <vector>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

template <class T>
using Vector2Of = Eigen::Matrix<T, 2, 1>;
template <class T>
using Vector3Of = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix2Of = Eigen::Matrix<T, 2, 2>;
template <class T>
using Matrix3Of = Eigen::Matrix<T, 3, 3>;
template <class T>
using PressuresRefOf = const Eigen::Ref<const Eigen::Matrix<T, Eigen::Dynamic, 1>>&;  // of double: PressuresRef

// Parallel circular chambers on one pitch circle. Shi et al. section 3.2.
// The braid keeps the chamber radius r_P; the pitch radius shrinks with the section, as 1/sqrt(stretch).
template <class T>
struct ChambersOf {
  T radius = T(0.0);        // r_P, m
  T pitch_radius = T(0.0);  // r_o at stretch 1, m
  std::vector<T> azimuths;  // phi_k from the x towards the y axis of the section, rad; one per chamber
  // gamma, 1/Pa: a chamber swells under its pressure and pushes on the area A_P (1 + gamma P). 0: the braid prevents
  // this, as in the paper. Below 1 / (2 atm), so that the force grows with the pressure everywhere, from vacuum up.
  T area_growth = T(0.0);

  int count() const { return static_cast<int>(azimuths.size()); }
  T area() const { return kPi * radius * radius; }  // A_P of one chamber without pressure, m^2

  // Pressure on A_P that gives the same force: P (1 + gamma P), Pa.
  T effectivePressure(const T& pressure) const { return pressure + area_growth * pressure * pressure; }

  // Centre d_k of chamber k in section axes at the given stretch (23), m.
  Vector3Of<T> centre(int k, const T& stretch) const {
    using std::cos, std::sin, std::sqrt;
    const T r = pitch_radius / sqrt(stretch);
    return {r * cos(azimuths[k]), r * sin(azimuths[k]), T(0.0)};
  }

  // F_P = sum_k P_k A_P (P_k the effective pressure), along e3 of the section (N). pressures: gauge, Pa, one per chamber.
  T actuationForce(PressuresRefOf<T> pressures) const {
    T sum(0.0);
    for (int k = 0; k < count(); ++k) sum += effectivePressure(pressures[k]);
    return area() * sum;
  }

  // T_P = sum_k d_k x (P_k A_P e3) in section axes (N m), with d_k at the given stretch. Its z is zero.
  Vector3Of<T> actuationMoment(PressuresRefOf<T> pressures, const T& stretch) const {
    Vector3Of<T> moment(T(0.0), T(0.0), T(0.0));
    for (int k = 0; k < count(); ++k) {
      const Vector3Of<T> d = centre(k, stretch);
      const T force = effectivePressure(pressures[k]) * area();
      moment += Vector3Of<T>(force * d.y(), -force * d.x(), T(0.0));  // d x e3
    }
    return moment;
  }
};
using Chambers = ChambersOf<double>;

}  // namespace live_stiffness
