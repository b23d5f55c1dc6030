#include "live_stiffness/section/cross_section.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

#include "section/section_moments.h"
#include "support/matrix_near.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

CrossSection paperSection() {
  Scene scene = paperScene(1);
  return segmentOf(scene, 0).section;
}

TEST(SectionMoments, AreaIsThePapers) {
  const CrossSection section = paperSection();
  for (double stretch : {0.8, 1.0, 1.5, 3.0}) {
    const double expected = kPi * ((0.0125 * 0.0125 - 0.0044 * 0.0044) / stretch - 6 * 0.00225 * 0.00225);
    EXPECT_NEAR(SectionMoments(section).area(stretch), expected, 1e-18);
    EXPECT_NEAR(section.area(stretch), expected, 1e-18);
  }
}

TEST(SectionMoments, SecondMomentsAreThePapers) {
  const double r_m1 = 0.0125, r_m2 = 0.0044, r_P = 0.00225, r_o = 0.00831;
  for (double stretch : {0.8, 1.0, 1.5, 3.0}) {
    double I_x = kPi * (std::pow(r_m1, 4) - std::pow(r_m2, 4)) / (4 * stretch * stretch), I_y = I_x;  // (24)
    for (double azimuth_deg : {-2.5, 2.5, 117.5, 122.5, 237.5, 242.5}) {
      const double own = kPi * std::pow(r_P, 4) / 4, area = kPi * r_P * r_P;
      I_x -= own + std::pow(r_o * std::sin(radians(azimuth_deg)), 2) * area / stretch;
      I_y -= own + std::pow(r_o * std::cos(radians(azimuth_deg)), 2) * area / stretch;
    }
    const Eigen::Matrix2d expected = Eigen::Vector2d(I_x, I_y).asDiagonal();
    EXPECT_TRUE(matrixNear(SectionMoments(paperSection()).secondMoments(stretch), expected, 1e-22));  // of 1e-8 m^4
  }
}

// A tube with three holes of any layout, by counting cells: knows nothing of Steiner's theorem.
TEST(SectionMoments, OfALopsidedLayoutAreTheIntegralOverTheSolidArea) {
  CrossSection section = paperSection();
  section.chambers.azimuths = {0.3, 1.1, 2.0};
  constexpr int kCells = 2000;
  const double cell = 2 * section.outer_radius / kCells;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const Vector3 r((i + 0.5) * cell - section.outer_radius, (j + 0.5) * cell - section.outer_radius, 0.0);
      const Eigen::Vector2d xy = r.head<2>();
      bool solid = r.norm() < section.outer_radius && r.norm() > section.lumen_radius;
      for (int k = 0; k < 3; ++k)
        solid = solid && (r - section.chambers.centre(k, 1.0)).norm() > section.chambers.radius;
      if (solid) sum += cell * cell * (xy.squaredNorm() * Eigen::Matrix2d::Identity() - xy * xy.transpose());
    }
  const Eigen::Matrix2d moments = SectionMoments(section).secondMoments(1.0);
  EXPECT_GT(std::abs(moments(0, 1)), 0.01 * moments.norm());  // else this proves nothing about the off-diagonal
  EXPECT_TRUE(matrixNear(moments, sum, 1e-4 * moments.norm()));  // staircase edges: about 1 / kCells^1.5
}

TEST(ComplianceDensity, IsTheInverseOfTheSectionsStiffness) {
  const CrossSection section = paperSection();
  const SectionMoments moments(section);
  const double A = moments.area(1.2), E = section.youngs_modulus, G = section.shear_modulus;
  const Eigen::Matrix2d I = moments.secondMoments(1.2);
  const ComplianceDensity c = moments.complianceDensity(1.2);
  Matrix3 K_se = Matrix3::Zero(), K_bt = Matrix3::Zero();
  K_se.diagonal() << 1.2421 * G * A, 1.2421 * G * A, E * A;
  K_bt.topLeftCorner<2, 2>() = E * I;
  K_bt(2, 2) = G * (I(0, 0) + I(1, 1));  // J = I_x + I_y
  EXPECT_TRUE(matrixNear(c.shear_elongation * K_se, Matrix3::Identity(), 1e-14));
  EXPECT_TRUE(matrixNear(c.bending_torsion * K_bt, Matrix3::Identity(), 1e-14));
}

TEST(SectionMoments, AreValidUpToTheStretchWhereNoSolidIsLeft) {
  const SectionMoments moments(paperSection());
  // design: lam < 4.5; area is zero at (r_m1^2 - r_m2^2) / (6 r_P^2).
  const double limit = (0.0125 * 0.0125 - 0.0044 * 0.0044) / (6 * 0.00225 * 0.00225);
  EXPECT_NEAR(limit, 4.5, 0.01);
  EXPECT_TRUE(moments.isValidAt(1.0));
  EXPECT_GT(moments.area(0.999 * limit), 0.0);
  EXPECT_FALSE(moments.isValidAt(1.001 * limit));
  EXPECT_FALSE(moments.isValidAt(0.0));
  EXPECT_FALSE(moments.isValidAt(-1.0));
  EXPECT_FALSE(moments.isValidAt(std::nan("")));
}

TEST(SectionMoments, AreInvalidWhenABendingStiffnessIsNegativeThoughTheAreaIsNot) {
  CrossSection section = paperSection();
  section.chambers.radius = 0.0035;
  section.chambers.pitch_radius = 0.009;
  section.chambers.azimuths = {0.0, 0.05, 0.1};  // on top of each other: one bending direction is hollowed out
  const SectionMoments moments(section);
  double stretch = 1.0;
  while (moments.isValidAt(stretch)) stretch += 1e-3;
  EXPECT_GT(moments.area(stretch), 0.0);
  EXPECT_LE(moments.secondMoments(stretch).determinant(), 0.0);
}

TEST(CrossSection, LinearDensityIsThatOfTheUnstretchedSolid) {
  const CrossSection section = paperSection();
  EXPECT_DOUBLE_EQ(section.linearDensity(), 1070.0 * section.area(1.0));
}

}  // namespace
}  // namespace live_stiffness
