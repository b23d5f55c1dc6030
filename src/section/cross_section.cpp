#include "live_stiffness/section/cross_section.h"

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
}

ComplianceDensity SectionMoments::complianceDensity(double stretch) const {
  const double A = area(stretch);
  const Eigen::Matrix2d I = secondMoments(stretch);
  const double GA = shear_stiffness_modulus_ * A;
  ComplianceDensity c;
  c.shear_elongation.diagonal() << 1.0 / GA, 1.0 / GA, 1.0 / (youngs_modulus_ * A);
  c.bending_torsion.topLeftCorner<2, 2>() = I.inverse() / youngs_modulus_;
  c.bending_torsion(2, 2) = 1.0 / (shear_modulus_ * I.trace());
  return c;
}

}  // namespace live_stiffness
