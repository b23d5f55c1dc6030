// What a solve claims about itself: its error, and that its history does not matter.

#include <gtest/gtest.h>

#include "live_stiffness/compliance/stiffness_model.h"
#include "support/errors.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

double errorOf(const StiffnessSolution& solution, const StiffnessSolution& exact, double length) {
  return std::max({poseError(solution.X_BT, exact.X_BT, length),
                   complianceError(solution.compliance, exact.compliance, length),
                   complianceError(solution.material_compliance, exact.material_compliance, length)});
}

// Seed 10 holds, for one segment, an element whose highest Legendre coefficient passes through zero: an estimate from
// that coefficient alone is 40 times too small there.
TEST(NumericalError, BoundsTheTrueErrorWithinAFactorOfTen) {
  for (int segments : {1, 2})
    for (unsigned seed : {7, 10}) {
      const Scene scene = paperScene(segments);
      const StiffnessModel exact(scene, accurateTo(1e-13));
      const StiffnessModel models[] = {{scene, accurateTo(1e-4)}, {scene, accurateTo(1e-5)}, {scene, accurateTo(1e-6)}};
      RandomSource random(seed);
      double worst_ratio = 0.0, worst_error = 0.0;
      int solved = 0;
      for (int i = 0; i < 300; ++i) {
        const Pressures pressures = random.pairs(6 * segments, -0.3e5, 1.2e5);
        const Wrench wrench = random.wrench(0.1, 2e-3);
        const StiffnessSolution a = solveCold(models[i % 3], pressures, wrench);
        const StiffnessSolution b = solveCold(exact, pressures, wrench);
        ASSERT_EQ(a.status.code, b.status.code) << i;
        if (a.status.code == SolveCode::kUnstable) continue;  // standing segments at their highest pressures may topple
        ASSERT_TRUE(a.status.ok()) << i;
        ++solved;
        const double error = errorOf(a, b, scene.length());
        // The reference itself is no better than its residual of 1e-12 rad.
        EXPECT_LE(error, 10.0 * a.numerical_error + 1e-11) << i << ", pressures " << pressures.transpose()
                                                           << ", wrench " << wrench.transpose();
        worst_ratio = std::max(worst_ratio, (error - 1e-11) / a.numerical_error);
        worst_error = std::max(worst_error, error);
      }
      EXPECT_GE(solved, 295);
      std::cout << segments << " segments: error at most " << worst_error << ", " << worst_ratio
                << " times numerical_error\n";
    }
}

TEST(Accuracy, IsMetOrReportedAsMissed) {
  for (double accuracy : {1e-4, 1e-6, 1e-9}) {
    const Scene scene = paperScene(2);
    const StiffnessModel model(scene, accurateTo(accuracy)), exact(scene, accurateTo(1e-13));
    RandomSource random(62);
    for (int i = 0; i < 50; ++i) {
      const Pressures pressures = random.pairs(12, 0.0, 1.2e5);
      const StiffnessSolution a = solveCold(model, pressures);
      EXPECT_LE(errorOf(a, solveCold(exact, pressures), scene.length()), 10.0 * accuracy) << i;
    }
  }
}

TEST(WarmStart, EqualsAColdSolveAlongARandomWalk) {
  for (int segments : {1, 2}) {
    const Scene scene = paperScene(segments);
    const StiffnessModel model(scene, accurateTo(1e-10));
    StiffnessWorkspace workspace = model.makeWorkspace();
    RandomSource random(63);
    Pressures pressures = random.pairs(6 * segments, 0.2e5, 0.8e5);
    for (int i = 0; i < 200; ++i) {
      pressures += random.pairs(6 * segments, -0.05e5, 0.05e5);
      pressures = pressures.cwiseMax(-0.2e5).cwiseMin(1.1e5);
      const StiffnessSolution warm = model.solve(pressures, Wrench::Zero(), workspace);
      const StiffnessSolution cold = solveCold(model, pressures);
      ASSERT_TRUE(warm.status.ok() && cold.status.ok()) << i;
      EXPECT_LT(errorOf(warm, cold, scene.length()), 1e-9) << i;
    }
  }
}

TEST(WarmStart, SurvivesJumpsOfPressureAndLoad) {
  const Scene scene = paperScene(2);
  const StiffnessModel model(scene, accurateTo(1e-10));
  StiffnessWorkspace workspace = model.makeWorkspace();
  RandomSource random(64);
  for (int i = 0; i < 100; ++i) {
    const Pressures pressures = random.pairs(12, 0.0, 0.7e5);
    const Wrench wrench = i % 3 == 0 ? Wrench(Wrench::Zero()) : random.wrench(0.03, 1e-3);
    const StiffnessSolution warm = model.solve(pressures, wrench, workspace);
    const StiffnessSolution cold = solveCold(model, pressures, wrench);
    ASSERT_TRUE(warm.status.ok() && cold.status.ok()) << i;
    EXPECT_LT(errorOf(warm, cold, scene.length()), 1e-9) << i;
  }
}

TEST(Workspace, RecoversAfterAFailedSolve) {
  const Scene scene = paperScene(2);
  const StiffnessModel model(scene, accurateTo(1e-10));
  StiffnessWorkspace workspace = model.makeWorkspace();
  const Pressures good = Pressures::Constant(12, 0.5e5);
  const StiffnessSolution before = model.solve(good, Wrench::Zero(), workspace);
  ASSERT_TRUE(before.status.ok());
  const auto solveBad = [&](const Pressures& pressures, const Wrench& wrench) {
    EXPECT_FALSE(model.solve(pressures, wrench, workspace).status.ok());
    const StiffnessSolution after = model.solve(good, Wrench::Zero(), workspace);
    ASSERT_TRUE(after.status.ok());
    EXPECT_LT(errorOf(after, before, scene.length()), 1e-9);
  };
  solveBad(Pressures::Constant(12, std::nan("")), Wrench::Zero());
  solveBad(Pressures::Constant(12, 3e5), Wrench::Zero());                // out of range
  solveBad(good, Wrench::Constant(1e9));                                 // no such equilibrium is to be found
}

}  // namespace
}  // namespace live_stiffness
