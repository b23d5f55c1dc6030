#include "live_stiffness/rod/conjugate_points.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/bare_rod.h"

namespace live_stiffness {
namespace {

// The straight elastica in `count` elements, shot with the given base moment.
Backbone shot(const BareRod& rod, const DeadLoads& loads, const Vector3& base_moment, int count) {
  Backbone backbone = rod.backbone();
  backbone.element_count[0] = count;
  backbone.elements.resize(count);
  Vector3 residual;
  EXPECT_TRUE(shoot(rod.scene, loads, base_moment, false, backbone, residual));
  EXPECT_LT(residual.norm(), 1e-4);
  return backbone;
}

// phi'' + P phi = 0 on the straight column: the first zero after the base is at pi / sqrt(P), a double one in 3-D.
TEST(ConjugatePoint, OfAStraightColumnIsAtHalfASineWave) {
  const BareRod rod = BareRod::elastica();
  for (double share : {0.1, 0.5, 0.99, 1.01, 2.0, 3.9, 4.1, 20.0})
    for (int count : {16, 37}) {
      DeadLoads loads;
      loads.tip[2] = -share * kPi * kPi;
      const Backbone backbone = shot(rod, loads, Vector3::Zero(), count);
      EXPECT_EQ(hasConjugatePoint(rod.scene, loads, backbone), share > 1.0) << share << ", " << count << " elements";
    }
}

TEST(ConjugatePoint, IsNotThereUnderTension) {
  const BareRod rod = BareRod::elastica();
  DeadLoads loads;
  loads.tip[2] = 100.0;
  EXPECT_FALSE(hasConjugatePoint(rod.scene, loads, shot(rod, loads, Vector3::Zero(), 16)));
}

// A rod pulled taut with a loop in it: the compliance of its tip is positive definite, and still the loop falls out.
TEST(ConjugatePoint, IsInALoopThatTheTipDoesNotSee) {
  const BareRod rod = BareRod::elastica();
  DeadLoads loads;
  linear(loads.tip) = 100.0 * Vector3(std::sin(2.5), 0.0, -std::cos(2.5));
  // Of the looped equilibrium; found once by a search that let it through, polished here.
  Vector3 m0(0.0, 6.11226, 0.0), residual;
  Backbone backbone = rod.backbone();
  backbone.element_count[0] = 38;
  backbone.elements.resize(38);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(shoot(rod.scene, loads, m0, false, backbone, residual));
    m0 -= tipColumns(rod.scene, loads, backbone).m.leftCols<3>().inverse() * residual;
  }
  ASSERT_LT(residual.norm(), 1e-9);
  const StateColumns tip = tipColumns(rod.scene, loads, backbone);
  const Matrix3 rotation_by_moment = tip.phi.leftCols<3>() * tip.m.leftCols<3>().inverse();
  EXPECT_EQ((0.5 * (rotation_by_moment + rotation_by_moment.transpose())).eval().llt().info(), Eigen::Success);
  EXPECT_TRUE(hasConjugatePoint(rod.scene, loads, backbone));
}

}  // namespace
}  // namespace live_stiffness
