// The energy minimiser of the tests against closed forms and against itself, so that it can judge the solver.

#include "support/energy_minimiser.h"

#include <gtest/gtest.h>

#include "support/bare_rod.h"
#include "support/elastica.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

constexpr double kEuler = kPi * kPi / 4.0;  // of the elastica

TEST(EnergyMinimiser, FindsTheElastica) {
  const BareRod rod = BareRod::elastica();
  for (double beta : {1e-4, 1e-2, 1.5})
    for (double share : {0.5, 1.5, 6.0}) {
      const double P = share * kEuler;
      const Wrench force = P * std::sin(beta) * Wrench::Unit(0) - P * std::cos(beta) * Wrench::Unit(2);
      const ExtrapolatedMinimum minimum = extrapolatedMinimum(rod.scene, {rod.rest}, force, 32);
      const Vector3 expected = elasticaTip(P, beta);
      EXPECT_TRUE(minimum.finest.isStable());
      EXPECT_LT((minimum.X_BT.p - expected).norm(), 0.1 * minimum.pose_error + 1e-14);
      EXPECT_LT(minimum.pose_error, 5e-8);  // of h^4 where h is 1/64
      // Turning the push turns the shape.
      EXPECT_NEAR(minimum.compliance(1, 1) * force[0] / expected.x(), 1.0, 1e-8);
    }
}

// A straight column is a saddle beyond its critical load, where h^2 P / 12 shifts the load; what is found leans anywhere.
TEST(EnergyMinimiser, LeavesTheSaddleOfAColumnForACircleOfMinima) {
  const BareRod rod = BareRod::elastica();
  for (double share : {0.5, 0.999, 1.001, 1.5, 6.0}) {
    const EnergyMinimum minimum = minimiseEnergy(rod.scene, {rod.rest}, -share * kEuler * Wrench::Unit(2), 64);
    EXPECT_TRUE(minimum.converged) << share;
    if (share < 1.0) {
      EXPECT_TRUE(minimum.isStable()) << share;
      EXPECT_NEAR(minimum.least_stiffness, 1.0 - share, 0.02 * (1.0 - share) + 1e-4);
    } else {
      EXPECT_TRUE(minimum.isNeutral()) << share << ": " << minimum.least_stiffness;
      // Elastica of a push sideways too small to matter; off by h^2 as the critical load is.
      const double across = elasticaTip(share * kEuler, 1e-7).x();
      EXPECT_NEAR(minimum.X_BT.p.head<2>().norm(), across, share < 1.1 ? 0.02 : 1e-3);
    }
  }
}

// Links, offset tip, oblique gravity: the tip is where the energy's derivative by the force says, and the compliance is the
// derivative of the tip.
TEST(EnergyMinimiser, HasTheComplianceOfDifferences) {
  const Scene scene = awkwardScene();
  const std::vector<RestState> rest = restStates(scene, RandomSource(5).pairs(12, 0.0, 0.6e5), ModelOptions{});
  constexpr double kForce = 1e-5;  // N; differences are good to its square and to 1e-16 / 1e-5
  constexpr int kIntervals = 16;
  const EnergyMinimum minimum = minimiseEnergy(scene, rest, Wrench::Zero(), kIntervals);
  ASSERT_TRUE(minimum.isStable());
  EXPECT_TRUE(matrixNear(minimum.compliance, minimum.compliance.transpose(), 1e-9));
  for (int axis = 0; axis < 3; ++axis) {
    const Wrench force = kForce * Wrench::Unit(axis);
    const EnergyMinimum plus = minimiseEnergy(scene, rest, force, kIntervals);
    const EnergyMinimum minus = minimiseEnergy(scene, rest, -force, kIntervals);
    EXPECT_NEAR((minus.energy - plus.energy) / (2.0 * kForce), minimum.X_BT.p[axis], 1e-8);
    const Twist slope = residualTwist(plus.X_BT, minus.X_BT) / (2.0 * kForce);
    EXPECT_TRUE(matrixNear(minimum.compliance.col(axis), slope, 1e-6 * minimum.compliance.col(axis).norm()));
  }
}

TEST(EnergyMinimiser, AgreesWithTheSolverAtShortChains) {
  RandomSource random(17);
  for (Scene scene : {paperScene(1), paperScene(2), awkwardScene()})
    for (int i = 0; i < 4; ++i) {
      scene.gravity = random.direction(9.81);
      const StiffnessModel model(scene, accurateTo(1e-10));
      const Pressures pressures = random.pairs(scene.chamberCount(), 0.0, 0.6e5);
      Wrench force = random.wrench(0.05, 0.0);
      const StiffnessSolution solution = solveCold(model, pressures, force);
      const ExtrapolatedMinimum minimum =
          extrapolatedMinimum(scene, restStates(scene, pressures, model.options()), force, 16);
      ASSERT_TRUE(solution.status.ok() && minimum.finest.isStable());
      EXPECT_LT(poseError(solution.X_BT, minimum.X_BT, scene.length()), 0.1 * minimum.pose_error + 1e-9);
      EXPECT_LT(complianceError(solution.compliance, minimum.compliance, scene.length()),
                0.1 * minimum.compliance_error + 1e-9);
      EXPECT_LT(minimum.pose_error + minimum.compliance_error, 1e-7);
    }
}

// Where nothing acts the energy is zero and cannot fall; there is nothing but rounding.
TEST(EnergyMinimiser, LeavesTheUnloadedRobotWhereItIs) {
  const Scene scene = weightlessPaperScene(2);
  const Pressures pressures = RandomSource(8).pairs(12, 0.0, 0.6e5);
  const StiffnessModel model(scene, accurateTo(1e-12));
  const StiffnessSolution solution = solveCold(model, pressures);
  const ExtrapolatedMinimum minimum =
      extrapolatedMinimum(scene, restStates(scene, pressures, model.options()), Wrench::Zero(), 16);
  EXPECT_TRUE(minimum.finest.isStable());
  EXPECT_LT(poseError(solution.X_BT, minimum.X_BT, scene.length()), 1e-9);
  EXPECT_LT(complianceError(solution.compliance, minimum.compliance, scene.length()), 1e-9);
}

TEST(EnergyMinimiser, RefusesADeadMoment) {
  const BareRod rod = BareRod::elastica();
  EXPECT_THROW(minimiseEnergy(rod.scene, {rod.rest}, Wrench::Unit(4), 8), std::invalid_argument);
}

}  // namespace
}  // namespace live_stiffness
