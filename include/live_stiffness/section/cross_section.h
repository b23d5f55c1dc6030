#pragma once
// Cross-section of a fluidic segment: sizes, chambers and material.

#include "live_stiffness/section/chambers.h"
#include "live_stiffness/section/material.h"

namespace live_stiffness {

// Elastomer tube of incompressible area change (16): at stretch lam, A_solid ~ 1/lam, lengths in the section ~
// 1/sqrt(lam), chambers of constant radius. Shi et al. (24), with two choices stated:
//  - bending uses the full tensor of second moments about the backbone, so that any chamber layout is allowed
//    (for the paper's it is isotropic and equals (24)); the shift of the area centroid of an asymmetric layout,
//    which couples stretch and bending, is neglected;
//  - torsion uses J = I_x + I_y (pi r_P^4 / 2 per chamber); (24) prints pi r_P^4 / 4, which is 0.4 % stiffer.
struct CrossSection {
  double outer_radius = 0.0;  // r_m1, m
  double lumen_radius = 0.0;  // r_m2, m
  Chambers chambers;
  double youngs_modulus = 0.0;    // E at stretch 1, Pa
  double shear_modulus = 0.0;     // G at stretch 1, Pa
  double shear_correction = 1.0;  // k in GA k, -
  double density = 0.0;           // rho, kg/m^3
  Material material;

  // Solid area A(lam), m^2. Falls to zero at the section's limit of stretch.
  double area(double stretch) const {
    return kPi * (outer_radius * outer_radius - lumen_radius * lumen_radius) / stretch -
           chambers.count() * chambers.area();
  }

  // Mass per unit of unstretched length rho A(1), kg/m.
  double linearDensity() const { return density * area(1.0); }
};

}  // namespace live_stiffness
