#include "support/accumulated_rest_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rod/backbone.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/pressure_cycles.h"
#include "support/scenes.h"
#include "support/rest_state.h"

namespace live_stiffness {
namespace {

CrossSection paperSection() {
  Scene scene = paperScene(1);
  return segmentOf(scene, 0).section;
}

const Pressures kBent = bars(1.1, {1, 1, 0.4, 0.4, 0, 0});

RestState alongStraightPath(const CrossSection& section, const Pressures& pressures, int steps) {
  AccumulatedRestState accumulated(section);
  for (int step = 1; step <= steps; ++step)
    EXPECT_TRUE(accumulated.advanceTo(static_cast<double>(step) / steps * pressures));
  return accumulated.state();
}

// Relative difference of all that a rest state holds.
double difference(const RestState& a, const RestState& b) {
  return std::max({std::abs(a.stretch / b.stretch - 1.0), (a.curvature - b.curvature).norm() / b.curvature.norm(),
                   (a.c.bending_torsion - b.c.bending_torsion).norm() / b.c.bending_torsion.norm(),
                   (a.c.shear_elongation - b.c.shear_elongation).norm() / b.c.shear_elongation.norm()});
}

TEST(AccumulatedRestState, EqualsFixedStepsWhenItTakesTheSameIncrements) {
  const CrossSection section = paperSection();
  for (int steps : {1, 8, 100}) {
    const RestState expected = restState(section, kBent, Stepping::kFixedStep, steps);
    EXPECT_LT(difference(alongStraightPath(section, kBent, steps), expected), 1e-13) << steps;  // rounding of 100 steps
  }
}

TEST(AccumulatedRestState, ConvergesToContinuousSteppingInFirstOrderOnAStraightPath) {
  const CrossSection section = paperSection();
  const RestState limit = restState(section, kBent, Stepping::kContinuous, 0);
  const auto error = [&](int steps) { return difference(alongStraightPath(section, kBent, steps), limit); };
  for (int steps : {1000, 10000}) EXPECT_NEAR(error(steps) / error(2 * steps), 2.0, 0.01) << steps;
  EXPECT_LT(error(100000), 2e-5);
}

TEST(AccumulatedRestState, DriftsOverACycleInProportionToTheIncrement) {
  const CrossSection section = paperSection();
  const auto drift = [&](double threshold) {
    AccumulatedRestState accumulated(section);
    RandomSource random(81);
    for (int cycle = 0; cycle < 10; ++cycle)
      pressureCycle(random, 6, 1.2e5, threshold, [&](const Pressures& p) { EXPECT_TRUE(accumulated.advanceTo(p)); });
    return std::abs(accumulated.state().stretch - 1.0);
  };
  EXPECT_NEAR(drift(200.0) / drift(100.0), 2.0, 0.1);
  EXPECT_GT(drift(15000.0), 1e-3);
}

TEST(AccumulatedRestState, RefusesWhatItCannotStepToAndStaysWhereItWas) {
  AccumulatedRestState accumulated(paperSection());
  ASSERT_TRUE(accumulated.advanceTo(kBent));
  const RestState before = accumulated.state();
  for (const Pressures& bad : {Pressures(Pressures::Constant(6, std::nan(""))), Pressures(Pressures::Zero(5)),
                               Pressures(Pressures::Constant(6, 1e7)), Pressures(Pressures::Constant(6, -1e7))}) {
    EXPECT_FALSE(accumulated.advanceTo(bad)) << bad.transpose();
    EXPECT_EQ(difference(accumulated.state(), before), 0.0);
  }
  accumulated.reset();
  EXPECT_EQ(accumulated.state().stretch, 1.0);
  EXPECT_TRUE(accumulated.state().curvature.isZero(0.0));
}

// The two policies over 1e5 random cycles.
TEST(Drift, DefaultPolicyReturnsExactlyToRestAndTheAccumulatingOneDoesNot) {
  constexpr int kCycles = 100000;
  const Scene scene = weightlessPaperScene(1);
  const StiffnessModel model(scene, {});
  const Pressures rest = Pressures::Zero(6);
  const StiffnessSolution at_rest = solveCold(model, rest);
  StiffnessWorkspace workspace = model.makeWorkspace();
  AccumulatedRestState accumulated(paperSection());
  RandomSource random(82);
  StiffnessSolution solution;
  for (int cycle = 0; cycle < kCycles; ++cycle)
    pressureCycle(random, 6, 1.2e5, 15000.0, [&](const Pressures& pressures) {
      ASSERT_TRUE(accumulated.advanceTo(pressures)) << cycle;
      if (cycle % 10 == 0 || pressures.isZero(0.0)) solution = model.solve(pressures, Wrench::Zero(), workspace);
    });
  EXPECT_TRUE(matrixNear(solution.X_BT.p, at_rest.X_BT.p, 0.0));
  EXPECT_TRUE(matrixNear(solution.X_BT.R, at_rest.X_BT.R, 0.0));
  EXPECT_TRUE(matrixNear(solution.compliance, at_rest.compliance, 0.0));
  EXPECT_GT(std::abs(accumulated.state().stretch - 1.0), 0.1);
}

// With weight the rest state is exactly the same, and the equilibrium as exact as one solve is.
TEST(Drift, DefaultPolicyReturnsToTheSameEquilibriumUnderWeight) {
  const Scene scene = paperScene(1);
  const StiffnessModel model(scene, accurateTo(1e-12));
  const Pressures rest = Pressures::Zero(6);
  const StiffnessSolution at_rest = solveCold(model, rest);
  StiffnessWorkspace workspace = model.makeWorkspace();
  RandomSource random(83);
  for (int cycle = 0; cycle < 20000; ++cycle) {
    model.solve(random.pairs(6, 0.0, 1.0e5), Wrench::Zero(), workspace);
    const StiffnessSolution solution = model.solve(rest, Wrench::Zero(), workspace);
    ASSERT_TRUE(solution.status.ok());
    ASSERT_EQ(workspace.backbone().rest[0].stretch, 1.0);
    ASSERT_LT(poseError(solution.X_BT, at_rest.X_BT, scene.length()), 1e-11) << cycle;
  }
}

}  // namespace
}  // namespace live_stiffness
