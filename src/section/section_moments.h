#pragma once
// Areas, second moments and compliance density of a cross-section as functions of stretch.

#include <cmath>

#include "live_stiffness/section/cross_section.h"

namespace live_stiffness {

// Compliance per unit of stretched length c = diag(c_se, c_bt) in section axes (2): shear and elongation (1/N),
// bending and torsion (1/(N m^2)).
struct ComplianceDensity {
  Matrix3 shear_elongation = Matrix3::Zero();
  Matrix3 bending_torsion = Matrix3::Zero();
};

// What the pressure in the chambers adds to a section's stiffness (Material::pressure_stiffening): b sum_k P_k A_P, N,
// and b sum_k P_k A_P (|d_k|^2 I - d_k d_k^T) with d_k at stretch 1, N m^2.
struct ChamberStiffness {
  double axial = 0.0;
  Eigen::Matrix2d bending = Eigen::Matrix2d::Zero();
};

// weight (|d|^2 I - d d^T).
inline Eigen::Matrix2d armSpread(const Vector3& d, double weight) {
  Eigen::Matrix2d spread;
  spread << weight * d.y() * d.y(), -weight * d.x() * d.y(), -weight * d.x() * d.y(), weight * d.x() * d.x();
  return spread;
}

// What gauge pressures, Pa, one per chamber, add to the stiffness.
inline ChamberStiffness chamberStiffness(const CrossSection& section, PressuresRef pressures) {
  ChamberStiffness stiffness;
  for (int k = 0; k < section.chambers.count(); ++k) {
    const double weight = section.material.pressure_stiffening * pressures[k] * section.chambers.area();
    const Vector3 d = section.chambers.centre(k, 1.0);
    stiffness.axial += weight;
    stiffness.bending += armSpread(d, weight);
  }
  return stiffness;
}

// What (24) needs of a section, gathered once for many stretches: A(lam) and I(lam) are polynomials in 1/lam.
class SectionMoments {
 public:
  explicit SectionMoments(const CrossSection& section)
      : tube_area_(kPi * (section.outer_radius * section.outer_radius - section.lumen_radius * section.lumen_radius)),
        chamber_area_(section.chambers.count() * section.chambers.area()),
        tube_moment_(kPi / 4.0 * (power4(section.outer_radius) - power4(section.lumen_radius))),
        chamber_moment_(section.chambers.count() * kPi / 4.0 * power4(section.chambers.radius)),
        chamber_spread_(Eigen::Matrix2d::Zero()),
        youngs_modulus_(section.youngs_modulus),
        shear_stiffness_modulus_(section.shear_correction * section.shear_modulus),
        shear_modulus_(section.shear_modulus),
        material_(section.material) {
    for (int k = 0; k < section.chambers.count(); ++k)
      chamber_spread_ += armSpread(section.chambers.centre(k, 1.0), section.chambers.area());
    hideRounding();
  }

  double area(double stretch) const { return tube_area_ / stretch - chamber_area_; }  // m^2

  // Tensor of second moments of area at a stretch in section axes, m^4: bending moment = E I curvature.
  Eigen::Matrix2d secondMoments(double stretch) const {
    const double shrink = 1.0 / stretch;
    Eigen::Matrix2d moments = -shrink * chamber_spread_;
    const double round = tube_moment_ * shrink * shrink - chamber_moment_;
    moments(0, 0) += round;
    moments(1, 1) += round;
    return moments;
  }

  // E_t A, N: axial force per logarithmic stretch, and E_t I, N m^2: bending moment per curvature of stretched length.
  double axialStiffness(double stretch, const ChamberStiffness& pressurised = {}) const {
    return youngs_modulus_ * tangentRatio(material_, stretch) * area(stretch) + pressurised.axial;
  }
  Eigen::Matrix2d bendingStiffness(double stretch, const ChamberStiffness& pressurised = {}) const {
    const double modulus = youngs_modulus_ * tangentRatio(material_, stretch);
    return modulus * secondMoments(stretch) + pressurised.bending / stretch;
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

  // True if A(lam) and I(lam) and the stiffnesses are positive, that is, if c(lam) exists. False for NaN.
  bool isValidAt(double stretch, const ChamberStiffness& pressurised = {}) const {
    if (!scaled(stretch).isValid()) return false;
    if (isPlain()) return true;
    return tangentRatio(material_, stretch) > 0.0 && axialStiffness(stretch, pressurised) > 0.0 &&
           isPositive(bendingStiffness(stretch, pressurised));
  }

  // c(lam). Requires isValidAt(stretch). Shear and torsion follow the stretch law with the same ratio; pressure does
  // not stiffen them.
  ComplianceDensity complianceDensity(double stretch, const ChamberStiffness& pressurised = {}) const {
    if (isPlain()) return plainDensity(scaled(stretch));
    const double ratio = tangentRatio(material_, stretch);
    const double GA = shear_stiffness_modulus_ * ratio * area(stretch);
    ComplianceDensity c;
    c.shear_elongation(0, 0) = c.shear_elongation(1, 1) = 1.0 / GA;
    c.shear_elongation(2, 2) = 1.0 / axialStiffness(stretch, pressurised);
    c.bending_torsion.topLeftCorner<2, 2>() = inverse(bendingStiffness(stretch, pressurised));
    c.bending_torsion(2, 2) = 1.0 / (shear_modulus_ * ratio * secondMoments(stretch).trace());
    return c;
  }

  static Eigen::Matrix2d inverse(const Eigen::Matrix2d& m) {
    const double scale = 1.0 / (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
    Eigen::Matrix2d result;
    result << scale * m(1, 1), -scale * m(0, 1), -scale * m(1, 0), scale * m(0, 0);
    return result;
  }

  // True for the paper's material: E_t = E, and pressure adds no stiffness.
  bool isPlain() const {
    return material_.law == StretchLaw::kSectionUpdate && material_.pressure_stiffening == 0.0;
  }
  const Material& material() const { return material_; }
  double youngsModulus() const { return youngs_modulus_; }
  double tubeArea() const { return tube_area_; }        // of the section without chambers, at stretch 1
  double chamberArea() const { return chamber_area_; }  // of all chambers, at any stretch

 private:
  // Symmetric layouts bend the same in all directions; rounding would hide that from what is quicker then.
  void hideRounding() {
    const double mean = 0.5 * chamber_spread_.trace(), rounding = 1e-14 * mean;
    if (std::abs(chamber_spread_(0, 0) - mean) <= rounding && std::abs(chamber_spread_(0, 1)) <= rounding)
      chamber_spread_ = mean * Eigen::Matrix2d::Identity();
  }
  // c where E_t = E.
  ComplianceDensity plainDensity(const Scaled& at) const {
    const double by_area = at.stretch / (at.area * youngs_modulus_);  // 1 / (E A)
    const double square = at.stretch * at.stretch, by_moment = square / (at.determinant() * youngs_modulus_);
    ComplianceDensity c;
    c.shear_elongation(0, 0) = c.shear_elongation(1, 1) = by_area * (youngs_modulus_ / shear_stiffness_modulus_);
    c.shear_elongation(2, 2) = by_area;
    c.bending_torsion(0, 0) = by_moment * at.yy;
    c.bending_torsion(1, 1) = by_moment * at.xx;
    c.bending_torsion(0, 1) = c.bending_torsion(1, 0) = -by_moment * at.xy;
    c.bending_torsion(2, 2) = square / (shear_modulus_ * (at.xx + at.yy));
    return c;
  }
  static double power4(double x) { return x * x * x * x; }
  static bool isPositive(const Eigen::Matrix2d& m) {
    return m(0, 0) + m(1, 1) > 0.0 && m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0) > 0.0;
  }

  double tube_area_, chamber_area_;
  double tube_moment_, chamber_moment_;
  Eigen::Matrix2d chamber_spread_;  // sum_k A_P (|d_k|^2 I - d_k d_k^T) at stretch 1
  double youngs_modulus_, shear_stiffness_modulus_, shear_modulus_;
  Material material_;
};

}  // namespace live_stiffness
