#include "live_stiffness/section/cross_section.h"

#include <cmath>

namespace live_stiffness {
namespace {

double power4(double x) { return x * x * x * x; }

}  // namespace

double CrossSection::area(double stretch) const { return SectionMoments(*this).area(stretch); }

SectionMoments::SectionMoments(const CrossSection& section)
    : tube_area_(kPi * (section.outer_radius * section.outer_radius - section.lumen_radius * section.lumen_radius)),
      chamber_area_(section.chambers.count() * section.chambers.area()),
      tube_moment_(kPi / 4.0 * (power4(section.outer_radius) - power4(section.lumen_radius))),
      chamber_moment_(section.chambers.count() * kPi / 4.0 * power4(section.chambers.radius)),
      chamber_spread_(Eigen::Matrix2d::Zero()),
      youngs_modulus_(section.youngs_modulus),
      shear_stiffness_modulus_(section.shear_correction * section.shear_modulus),
      shear_modulus_(section.shear_modulus) {
  for (int k = 0; k < section.chambers.count(); ++k) {
    const Eigen::Vector2d d = section.chambers.centre(k, 1.0).head<2>();
    chamber_spread_ +=
        section.chambers.area() * (d.squaredNorm() * Eigen::Matrix2d::Identity() - d * d.transpose());
  }
  // Symmetric layouts bend the same in all directions; rounding would hide that from what is quicker then.
  const double mean = 0.5 * chamber_spread_.trace(), rounding = 1e-14 * mean;
  if (std::abs(chamber_spread_(0, 0) - mean) <= rounding && std::abs(chamber_spread_(0, 1)) <= rounding)
    chamber_spread_ = mean * Eigen::Matrix2d::Identity();
}

ComplianceDensity SectionMoments::complianceDensity(double stretch) const {
  const Scaled at = scaled(stretch);
  const double by_area = stretch / (at.area * youngs_modulus_);  // 1 / (E A)
  const double by_moment = stretch * stretch / (at.determinant() * youngs_modulus_);
  ComplianceDensity c;
  c.shear_elongation(0, 0) = c.shear_elongation(1, 1) = by_area * (youngs_modulus_ / shear_stiffness_modulus_);
  c.shear_elongation(2, 2) = by_area;
  c.bending_torsion(0, 0) = by_moment * at.yy;
  c.bending_torsion(1, 1) = by_moment * at.xx;
  c.bending_torsion(0, 1) = c.bending_torsion(1, 0) = -by_moment * at.xy;
  c.bending_torsion(2, 2) = stretch * stretch / (shear_modulus_ * (at.xx + at.yy));
  return c;
}

}  // namespace live_stiffness
