#pragma once
// Cross-section of a fluidic segment: areas, second moments and compliance density as functions of stretch.

#include <Eigen/LU>

#include "live_stiffness/conventions.h"
#include "live_stiffness/section/chambers.h"

namespace live_stiffness {

// Compliance per unit of stretched length c = diag(c_se, c_bt) in section axes (2): shear and elongation (1/N),
// bending and torsion (1/(N m^2)).
struct ComplianceDensity {
  Matrix3 shear_elongation = Matrix3::Zero();  // diagonal
  Matrix3 bending_torsion = Matrix3::Zero();   // full in x and y, z apart
};

// Elastomer tube of incompressible area change (16): at stretch lam, A_solid ~ 1/lam, lengths in the section ~
// 1/sqrt(lam), chambers of constant radius. Shi et al. (24), with two choices stated:
//  - bending uses the full tensor of second moments about the backbone, so that any chamber layout is allowed
//    (for the paper's it is isotropic and equals (24)); the shift of the area centroid of a lopsided layout, a
//    coupling of stretch and bending, is left out;
//  - torsion uses J = I_x + I_y (pi r_P^4 / 2 per chamber); (24) prints pi r_P^4 / 4, which is 0.4 % stiffer.
struct CrossSection {
  double outer_radius = 0.0;  // r_m1, m
  double lumen_radius = 0.0;  // r_m2, m
  Chambers chambers;
  double youngs_modulus = 0.0;    // E, Pa
  double shear_modulus = 0.0;     // G, Pa
  double shear_correction = 1.0;  // k in GA k, -
  double density = 0.0;           // rho, kg/m^3

  // Solid area A(lam), m^2. Falls to zero at the section's limit of stretch.
  double area(double stretch) const;

  // Mass per unit of unstretched length rho A(1), kg/m.
  double linearDensity() const { return density * area(1.0); }
};

// What (24) needs of a section, gathered once for many stretches: A(lam) and I(lam) are polynomials in 1/lam.
class SectionMoments {
 public:
  explicit SectionMoments(const CrossSection& section);

  double area(double stretch) const { return tube_area_ / stretch - chamber_area_; }  // m^2

  // Tensor of second moments of area at a stretch in section axes, m^4: bending moment = E I curvature.
  Eigen::Matrix2d secondMoments(double stretch) const {
    const double shrink = 1.0 / stretch;
    Eigen::Matrix2d moments = chamber_spread_ * -shrink;
    moments.diagonal().array() += tube_moment_ * shrink * shrink - chamber_moment_;
    return moments;
  }

  // lam A(lam) and lam^2 I(lam), without a division.
  struct Scaled {
    double stretch, area, xx, xy, yy;

    double determinant() const { return xx * yy - xy * xy; }
    // A(lam) and I(lam) are positive. False for NaN.
    bool isValid() const { return stretch > 0.0 && area > 0.0 && xx + yy > 0.0 && determinant() > 0.0; }
  };
  Scaled scaled(double stretch) const {
    const double moment = tube_moment_ - chamber_moment_ * stretch * stretch;
    return {stretch, tube_area_ - chamber_area_ * stretch, moment - stretch * chamber_spread_(0, 0),
            -stretch * chamber_spread_(0, 1), moment - stretch * chamber_spread_(1, 1)};
  }

  // True if A(lam) and I(lam) are positive, that is, if c(lam) exists. False for NaN.
  bool isValidAt(double stretch) const { return scaled(stretch).isValid(); }

  // c(lam). Requires isValidAt(stretch).
  ComplianceDensity complianceDensity(double stretch) const;

  double youngsModulus() const { return youngs_modulus_; }
  double tubeArea() const { return tube_area_; }        // of the section without chambers, at stretch 1
  double chamberArea() const { return chamber_area_; }  // of all chambers, at any stretch

 private:
  double tube_area_, chamber_area_;
  double tube_moment_, chamber_moment_;
  Eigen::Matrix2d chamber_spread_;  // sum_k A_P (|d_k|^2 I - d_k d_k^T) at stretch 1
  double youngs_modulus_, shear_stiffness_modulus_, shear_modulus_;
};

}  // namespace live_stiffness
