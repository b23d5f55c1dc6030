#pragma once
// Areas, second moments and compliance density of a cross-section as functions of stretch.
//
// T is double, or a type that carries derivatives.

#include <cmath>
#include <type_traits>

#include "live_stiffness/section/cross_section.h"

namespace live_stiffness {

// Compliance per unit of stretched length c = diag(c_se, c_bt) in section axes (2): shear and elongation (1/N),
// bending and torsion (1/(N m^2)).
template <class T>
struct ComplianceDensityOf {
  Matrix3Of<T> shear_elongation = Matrix3Of<T>::Constant(T(0.0));
  Matrix3Of<T> bending_torsion = Matrix3Of<T>::Constant(T(0.0));
};
using ComplianceDensity = ComplianceDensityOf<double>;

// What the pressure in the chambers adds to a section's stiffness (Material::pressure_stiffening): b sum_k P_k A_P, N,
// and b sum_k P_k A_P (|d_k|^2 I - d_k d_k^T) with d_k at stretch 1, N m^2.
template <class T>
struct ChamberStiffnessOf {
  T axial = T(0.0);
  Matrix2Of<T> bending = Matrix2Of<T>::Constant(T(0.0));
};

// weight (|d|^2 I - d d^T).
template <class T>
Matrix2Of<T> armSpread(const Vector3Of<T>& d, const T& weight) {
  Matrix2Of<T> spread;
  spread << weight * d.y() * d.y(), -weight * d.x() * d.y(), -weight * d.x() * d.y(), weight * d.x() * d.x();
  return spread;
}

// What gauge pressures, Pa, one per chamber, add to the stiffness.
inline ChamberStiffnessOf<double> chamberStiffness(const CrossSection& section, PressuresRef pressures) {
  ChamberStiffnessOf<double> stiffness;
  for (int k = 0; k < section.chambers.count(); ++k) {
    const double weight = section.material.pressure_stiffening * pressures[k] * section.chambers.area();
    const Vector3 d = section.chambers.centre(k, 1.0);
    stiffness.axial += weight;
    stiffness.bending += armSpread(d, weight);
  }
  return stiffness;
}

// What (24) needs of a section, gathered once for many stretches: A(lam) and I(lam) are polynomials in 1/lam.
template <class T>
class SectionMomentsOf {
 public:
  using ChamberStiffness = ChamberStiffnessOf<T>;

  explicit SectionMomentsOf(const CrossSectionOf<T>& section)
      : tube_area_(kPi * (section.outer_radius * section.outer_radius - section.lumen_radius * section.lumen_radius)),
        chamber_area_(static_cast<double>(section.chambers.count()) * section.chambers.area()),
        tube_moment_(kPi / 4.0 * (power4(section.outer_radius) - power4(section.lumen_radius))),
        chamber_moment_(static_cast<double>(section.chambers.count()) * kPi / 4.0 * power4(section.chambers.radius)),
        chamber_spread_(Matrix2Of<T>::Constant(T(0.0))),
        youngs_modulus_(section.youngs_modulus),
        shear_stiffness_modulus_(section.shear_correction * section.shear_modulus),
        shear_modulus_(section.shear_modulus),
        material_(section.material) {
    for (int k = 0; k < section.chambers.count(); ++k)
      chamber_spread_ += armSpread(section.chambers.centre(k, T(1.0)), section.chambers.area());
    if constexpr (std::is_same_v<T, double>) hideRounding();
  }

  T area(const T& stretch) const { return tube_area_ / stretch - chamber_area_; }  // m^2

  // Tensor of second moments of area at a stretch in section axes, m^4: bending moment = E I curvature.
  Matrix2Of<T> secondMoments(const T& stretch) const {
    const T shrink = 1.0 / stretch;
    Matrix2Of<T> moments = chamber_spread_ * T(-shrink);
    const T round = tube_moment_ * shrink * shrink - chamber_moment_;
    moments(0, 0) += round;
    moments(1, 1) += round;
    return moments;
  }

  // E_t A, N: axial force per logarithmic stretch, and E_t I, N m^2: bending moment per curvature of stretched length.
  T axialStiffness(const T& stretch, const ChamberStiffness& pressurised = {}) const {
    return youngs_modulus_ * tangentRatio(material_, stretch) * area(stretch) + pressurised.axial;
  }
  Matrix2Of<T> bendingStiffness(const T& stretch, const ChamberStiffness& pressurised = {}) const {
    const T modulus = youngs_modulus_ * tangentRatio(material_, stretch);
    return modulus * secondMoments(stretch) + pressurised.bending * T(1.0 / stretch);
  }

  // lam A(lam) and lam^2 I(lam), without a division.
  struct Scaled {
    T stretch, area, xx, xy, yy;

    T determinant() const { return xx * yy - xy * xy; }
    // A(lam) and I(lam) are positive. False for NaN.
    bool isValid() const { return stretch > 0.0 && area > 0.0 && xx + yy > 0.0 && determinant() > 0.0; }
  };
  Scaled scaled(const T& stretch) const {
    const T moment = tube_moment_ - chamber_moment_ * stretch * stretch;
    return {stretch, tube_area_ - chamber_area_ * stretch, moment - stretch * chamber_spread_(0, 0),
            -stretch * chamber_spread_(0, 1), moment - stretch * chamber_spread_(1, 1)};
  }

  // True if A(lam) and I(lam) and the stiffnesses are positive, that is, if c(lam) exists. False for NaN.
  bool isValidAt(const T& stretch, const ChamberStiffness& pressurised = {}) const {
    if (!scaled(stretch).isValid()) return false;
    if (isPlain()) return true;
    return tangentRatio(material_, stretch) > 0.0 && axialStiffness(stretch, pressurised) > 0.0 &&
           isPositive(bendingStiffness(stretch, pressurised));
  }

  // c(lam). Requires isValidAt(stretch). Shear and torsion follow the stretch law with the same ratio; pressure does
  // not stiffen them.
  ComplianceDensityOf<T> complianceDensity(const T& stretch, const ChamberStiffness& pressurised = {}) const {
    if (isPlain()) return plainDensity(scaled(stretch));
    const T ratio = tangentRatio(material_, stretch);
    const T GA = shear_stiffness_modulus_ * ratio * area(stretch);
    ComplianceDensityOf<T> c;
    c.shear_elongation(0, 0) = c.shear_elongation(1, 1) = 1.0 / GA;
    c.shear_elongation(2, 2) = 1.0 / axialStiffness(stretch, pressurised);
    c.bending_torsion.template topLeftCorner<2, 2>() = inverse(bendingStiffness(stretch, pressurised));
    c.bending_torsion(2, 2) = 1.0 / (shear_modulus_ * ratio * secondMoments(stretch).trace());
    return c;
  }

  static Matrix2Of<T> inverse(const Matrix2Of<T>& m) {
    const T scale = 1.0 / (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
    Matrix2Of<T> result;
    result << scale * m(1, 1), -scale * m(0, 1), -scale * m(1, 0), scale * m(0, 0);
    return result;
  }

  // True for the paper's material: E_t = E, and pressure adds no stiffness.
  bool isPlain() const {
    return material_.law == StretchLaw::kSectionUpdate && isZeroForGood(material_.pressure_stiffening);
  }
  const MaterialOf<T>& material() const { return material_; }
  const T& youngsModulus() const { return youngs_modulus_; }
  const T& tubeArea() const { return tube_area_; }        // of the section without chambers, at stretch 1
  const T& chamberArea() const { return chamber_area_; }  // of all chambers, at any stretch

 private:
  // Symmetric layouts bend the same in all directions; rounding would hide that from what is quicker then.
  void hideRounding() {
    const double mean = 0.5 * chamber_spread_.trace(), rounding = 1e-14 * mean;
    if (std::abs(chamber_spread_(0, 0) - mean) <= rounding && std::abs(chamber_spread_(0, 1)) <= rounding)
      chamber_spread_ = mean * Eigen::Matrix2d::Identity();
  }
  // c where E_t = E.
  ComplianceDensityOf<T> plainDensity(const Scaled& at) const {
    const T by_area = at.stretch / (at.area * youngs_modulus_);  // 1 / (E A)
    const T square = at.stretch * at.stretch, by_moment = square / (at.determinant() * youngs_modulus_);
    ComplianceDensityOf<T> c;
    c.shear_elongation(0, 0) = c.shear_elongation(1, 1) = by_area * (youngs_modulus_ / shear_stiffness_modulus_);
    c.shear_elongation(2, 2) = by_area;
    c.bending_torsion(0, 0) = by_moment * at.yy;
    c.bending_torsion(1, 1) = by_moment * at.xx;
    c.bending_torsion(0, 1) = c.bending_torsion(1, 0) = -by_moment * at.xy;
    c.bending_torsion(2, 2) = square / (shear_modulus_ * (at.xx + at.yy));
    return c;
  }
  static T power4(const T& x) { return x * x * x * x; }
  static bool isPositive(const Matrix2Of<T>& m) {
    return m(0, 0) + m(1, 1) > 0.0 && m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0) > 0.0;
  }

  T tube_area_, chamber_area_;
  T tube_moment_, chamber_moment_;
  Matrix2Of<T> chamber_spread_;  // sum_k A_P (|d_k|^2 I - d_k d_k^T) at stretch 1
  T youngs_modulus_, shear_stiffness_modulus_, shear_modulus_;
  MaterialOf<T> material_;
};
using SectionMoments = SectionMomentsOf<double>;

}  // namespace live_stiffness
