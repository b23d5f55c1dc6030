// Stability: in how many directions the energy of an equilibrium does not grow, by the pivots of the Riccati sweep.

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "rod/shooting.h"
#include "rod/statics.h"
#include "support/bare_rod.h"
#include "support/elastica.h"

namespace live_stiffness {
namespace {

// The rod in `count` elements, each integrated, one after the other, from the given base moment.
Backbone shot(const BareRod& rod, const DeadLoads& loads, const Vector3& base_moment, int count) {
  Backbone backbone = rod.backbone();
  const Chain chain(rod.scene);
  backbone.resize({count}, kMaxStages);
  prepare(chain, loads, backbone);
  Vector3 residual;
  EXPECT_TRUE(shoot(chain, loads, base_moment, false, backbone, residual));
  return backbone;
}

LinearisationResult linearised(const BareRod& rod, const DeadLoads& loads, Backbone& backbone, bool clamped) {
  const Chain chain(rod.scene);
  const LinearisationResult result =
      backbone.kernel->linearise(stateOf(chain, loads, Vector3::Zero(), backbone), {1e-12, true, true, false, clamped});
  EXPECT_LT(result.left, 1e-12);
  return result;
}

DeadLoads along(double force) {
  DeadLoads loads;
  loads.tip[2] = force;
  return loads;
}

// phi'' + P phi = 0 on the straight column, in two planes. Free, its tip does not bend, and it buckles at the odd multiples
// of a quarter wave; clamped, its tip does not turn, and it buckles at the multiples of half a wave.
TEST(SecondVariation, OfAStraightColumnCountsTheLoadsAtWhichItBuckles) {
  const BareRod rod = BareRod::elastica();
  for (double waves : {0.01, 0.2, 0.249, 0.251, 0.4, 0.499, 0.501, 0.7, 0.749, 0.751, 0.999, 1.001, 1.3, 3.7})
    for (int count : {1, 2, 16, 37}) {
      if (waves / count >= 0.5) continue;  // an element must not buckle between clamped ends itself
      const DeadLoads loads = along(-std::pow(2.0 * kPi * waves, 2));
      Backbone backbone = shot(rod, loads, Vector3::Zero(), count);
      const int free = 2 * static_cast<int>(std::floor(2.0 * waves + 0.5));
      const int clamped = 2 * static_cast<int>(std::floor(2.0 * waves));
      EXPECT_EQ(linearised(rod, loads, backbone, false).unstable, free) << waves << " waves, " << count << " elements";
      EXPECT_EQ(linearised(rod, loads, backbone, true).unstable, clamped) << waves << " waves, " << count << " elements";
    }
}

// One that bends more easily about one axis passes each of its loads in one plane at a time.
TEST(SecondVariation, CountsThePlanesOfAColumnOneByOne) {
  BareRod rod = BareRod::elastica();
  rod.rest.c.bending_torsion(0, 0) = 1.5;
  const double euler = kPi * kPi / 4.0;
  for (const auto& [load, unstable] : {std::pair(0.99 / 1.5, 0), {1.01 / 1.5, 1}, {0.99, 1}, {1.01, 2}, {8.9, 3}, {9.1, 4}}) {
    const DeadLoads loads = along(-load * euler);
    Backbone backbone = shot(rod, loads, Vector3::Zero(), 16);
    EXPECT_EQ(linearised(rod, loads, backbone, false).unstable, unstable) << load;
  }
}

TEST(SecondVariation, IsPositiveUnderTension) {
  const BareRod rod = BareRod::elastica();
  for (double force : {1.0, 100.0, 1e4}) {
    Backbone backbone = shot(rod, along(force), Vector3::Zero(), 64);
    for (bool clamped : {false, true}) EXPECT_EQ(linearised(rod, along(force), backbone, clamped).unstable, 0) << force;
  }
}

// Reissner's column: the load is of the discretised rod only to its order, so the solver's own is as near to it as asked for.
TEST(Stability, OfAColumnEndsAtItsBucklingLoad) {
  const double GA = 20.0, EA = 50.0, euler = kPi * kPi / 4.0;
  double critical = euler;
  for (int i = 0; i < 100; ++i) critical = euler / (1.0 - critical / EA + critical / GA);
  for (double gap : {1e-1, 1e-3, 1e-5}) {
    const BareRod rod(1.0, 1.0, 1.0, GA, EA);
    for (double share : {1.0 - gap, 1.0 + gap}) {
      StaticsSolver solver(rod.scene, 1e-9);
      Backbone backbone = rod.backbone();
      DeadLoads loads = along(-share * critical);
      const StaticsReport report = solver.solve(loads, backbone);
      EXPECT_TRUE(report.converged) << share;
      EXPECT_EQ(report.stable, share < 1.0) << share;
      // Where any direction is softer than the others, it is stable there.
      BareRod flat = rod;
      flat.rest.c.bending_torsion(0, 0) *= 0.5;
      StaticsSolver other(flat.scene, 1e-9);
      Backbone leaning = flat.backbone();
      EXPECT_TRUE(other.solve(loads, leaning).stable) << share;
      EXPECT_EQ(std::abs(leaning.X_BT.p.x()) > std::sqrt(0.1 * gap), share > 1.0) << share << ": " << leaning.X_BT.p.transpose();
      EXPECT_NEAR(leaning.X_BT.p.y(), 0.0, 1e-9) << share;
    }
  }
}

// Beyond the first of several loads the tip's compliance tells nothing: twice past it is positive definite again.
TEST(Stability, IsNotReadOffTheTip) {
  const BareRod rod = BareRod::elastica();
  const DeadLoads loads = along(-5.0 * kPi * kPi / 4.0);
  Backbone backbone = shot(rod, loads, Vector3::Zero(), 16);
  ASSERT_EQ(linearised(rod, loads, backbone, false).unstable, 2);
  Matrix6 C;
  backbone.kernel->tangent(&backbone.elements[0].state, 16, false, C.data());
  const Matrix3 rotation = C.bottomRightCorner<3, 3>();
  EXPECT_EQ(rotation.llt().info(), Eigen::Success);
  StaticsSolver solver(rod.scene, 1e-9);
  EXPECT_FALSE(solver.solve(loads, backbone).stable);
}

// A rod pulled taut with a loop in it: the compliance of its tip is positive definite, and still the loop falls out.
TEST(SecondVariation, SeesALoopThatTheTipDoesNot) {
  const BareRod rod = BareRod::elastica();
  const Chain chain(rod.scene);
  DeadLoads loads;
  linear(loads.tip) = 100.0 * Vector3(std::sin(2.5), 0.0, -std::cos(2.5));
  // Of the looped equilibrium; found once by a search that let it through, polished here.
  constexpr int kCount = 38;
  Backbone backbone = shot(rod, loads, Vector3(0.0, 6.11226, 0.0), kCount);
  const ChainState state = stateOf(chain, loads, Vector3::Zero(), backbone);
  IterationResult result;
  LinearisationResult linearisation = linearised(rod, loads, backbone, false);
  for (int i = 0; i < 40; ++i) {
    backbone.kernel->iterate_all(state, result);
    backbone.kernel->correct(state, result, 1.0);
    if (i % 10 == 9) {
      backbone.kernel->evaluate_all(state);
      linearisation = linearised(rod, loads, backbone, false);
    }
  }
  ASSERT_LT(std::max({result.moment, result.turn, result.change}), 1e-9);
  Matrix6 C;
  backbone.kernel->tangent(&backbone.elements[0].state, kCount, false, C.data());
  EXPECT_EQ((0.5 * (C + C.transpose())).eval().llt().info(), Eigen::Success) << C;
  EXPECT_GT(linearisation.unstable, 0);
  // The solver does not return it.
  StaticsSolver solver(rod.scene, 1e-9);
  Backbone solved = rod.backbone();
  ASSERT_TRUE(solver.solve(loads, solved).stable);
  EXPECT_LT((solved.X_BT.p - elasticaTip(100.0, 2.5)).norm(), 1e-8);
}

}  // namespace
}  // namespace live_stiffness
