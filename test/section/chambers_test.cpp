#include "live_stiffness/section/chambers.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/matrix_near.h"

namespace live_stiffness {
namespace {

Chambers fourChambers() { return {0.002, 0.008, {0.0, 0.5 * kPi, kPi, 1.5 * kPi}}; }

TEST(Chambers, CentresShrinkWithTheSquareRootOfStretch) {
  const Chambers chambers = fourChambers();
  EXPECT_TRUE(matrixNear(chambers.centre(1, 1.0), Vector3(0.0, 0.008, 0.0), 1e-17));
  EXPECT_TRUE(matrixNear(chambers.centre(1, 4.0), Vector3(0.0, 0.004, 0.0), 1e-17));
}

TEST(Chambers, ForceIsPressureTimesAreaOfAll) {
  const Pressures pressures = (Pressures(4) << 1e5, 2e5, -0.5e5, 0.0).finished();
  EXPECT_DOUBLE_EQ(fourChambers().actuationForce(pressures), 2.5e5 * kPi * 4e-6);
}

TEST(Chambers, OneChamberPushesTheTipAwayFromItsSide) {
  // Chamber on the +x side: d x F = x^ x z^ = -y^. A moment about -y turns z towards -x.
  const Pressures pressures = Pressures::Unit(4, 0) * 1e5;
  const Vector3 expected(0.0, -0.008 * 1e5 * kPi * 4e-6, 0.0);
  EXPECT_TRUE(matrixNear(fourChambers().actuationMoment(pressures, 1.0), expected, 1e-17));
}

TEST(Chambers, MomentIsTheSumOfCrossProducts) {
  const Chambers chambers{0.002, 0.008, {0.1, 0.9, 2.2, 4.0}};
  const Pressures pressures = (Pressures(4) << 1e5, 2e5, -0.5e5, 3e5).finished();
  Vector3 expected = Vector3::Zero();
  for (int k = 0; k < 4; ++k)
    expected += chambers.centre(k, 1.3).cross(Vector3(0.0, 0.0, pressures[k] * chambers.area()));
  EXPECT_TRUE(matrixNear(chambers.actuationMoment(pressures, 1.3), expected, 1e-16));
}

TEST(Chambers, EqualPressuresExertNoMoment) {
  EXPECT_TRUE(matrixNear(fourChambers().actuationMoment(Pressures::Constant(4, 1e5), 1.0), Vector3::Zero(), 1e-17));
}

TEST(Chambers, NoneExertNothing) {
  const Chambers none;
  EXPECT_EQ(none.actuationForce(Pressures()), 0.0);
  EXPECT_TRUE(matrixNear(none.actuationMoment(Pressures(), 1.0), Vector3::Zero(), 0.0));
}

}  // namespace
}  // namespace live_stiffness
