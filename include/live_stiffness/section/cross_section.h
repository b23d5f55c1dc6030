#pragma once
// Cross-section of a fluidic segment: sizes, chambers and material.
//
// T is double, or a type that carries derivatives.

#include "live_stiffness/section/chambers.h"
#include "live_stiffness/section/material.h"

namespace live_stiffness {

// Elastomer tube of incompressible area change (16): at stretch lam, A_solid ~ 1/lam, lengths in the section ~
// 1/sqrt(lam), chambers of constant radius. Shi et al. (24), with two choices stated:
//  - bending uses the full tensor of second moments about the backbone, so that any chamber layout is allowed
//    (for the paper's it is isotropic and equals (24)); the shift of the area centroid of an asymmetric layout,
//    which couples stretch and bending, is neglected;
//  - torsion uses J = I_x + I_y (pi r_P^4 / 2 per chamber); (24) prints pi r_P^4 / 4, which is 0.4 % stiffer.
template <class T>
struct CrossSectionOf {
  T outer_radius = T(0.0);  // r_m1, m
  T lumen_radius = T(0.0);  // r_m2, m
  ChambersOf<T> chambers;
  T youngs_modulus = T(0.0);    // E at stretch 1, Pa
  T shear_modulus = T(0.0);     // G at stretch 1, Pa
  T shear_correction = T(1.0);  // k in GA k, -
  T density = T(0.0);           // rho, kg/m^3
  MaterialOf<T> material;

  // Solid area A(lam), m^2. Falls to zero at the section's limit of stretch.
  T area(const T& stretch) const {
    return kPi * (outer_radius * outer_radius - lumen_radius * lumen_radius) / stretch -
           static_cast<double>(chambers.count()) * chambers.area();
  }

  // Mass per unit of unstretched length rho A(1), kg/m.
  T linearDensity() const { return density * area(T(1.0)); }
};
using CrossSection = CrossSectionOf<double>;

}  // namespace live_stiffness
