// The opponents of the speed report solve the same problem as the library, each to its own order.

#include <gtest/gtest.h>

#include <cmath>

#include "benchmark/methods/common_practice.h"
#include "benchmark/methods/energy_minimum.h"
#include "benchmark/methods/magnus.h"
#include "benchmark/methods/method_list.h"
#include "benchmark/methods/rk4_sensitivities.h"
#include "benchmark/scene_paths.h"

namespace live_stiffness {
namespace {

// What a method may err on the scenes below: its order in its resolution, with a constant 1.5 to 2 times the largest
// measured. Finite differences: step and rounding, on the softest scene.
double errorBound(const MethodEntry& entry) {
  const double n = entry.resolution;
  if (entry.family == "textbook (Till)" || entry.family == "optimised (Till)") return 5e-5;
  if (entry.family == "common practice" || entry.family == "common practice (tuned)") return 1e-5;
  if (entry.family == "RK4 with sensitivities") return 0.2 / std::pow(n, 4);
  if (entry.family == "Magnus 4") return 8e-3 / std::pow(n, 4);
  if (entry.family == "Magnus 6") return 4e-4 / std::pow(n, 6);
  if (entry.family == "library by stages") return accuracyOfStages(static_cast<int>(n));
  if (entry.family == "library" || entry.family == "library (plain x86-64)") return n;  // its accuracy
  return 0.0;
}

TEST(Methods, AgreeWithTheLibraryEachWithinItsOwnError) {
  for (const Scene& scene :
       {paperScene(1), paperScene(2), weightlessPaperScene(1), weightlessPaperScene(2), awkwardScene()}) {
    const std::vector<Pressures> path = pressurePath(scene.segmentCount());
    const std::vector<StiffnessSolution> exact = exactSolutions(scene, path);
    for (const MethodEntry& entry : methodList()) {
      const std::unique_ptr<StiffnessMethod> method = entry.make(scene);
      for (size_t i = 0; i < path.size(); i += 32) {
        const StiffnessSolution solution = method->solve(path[i]);
        ASSERT_TRUE(solution.status.ok()) << method->name() << " at " << i;
        EXPECT_LT(errorsOf(solution, exact[i], scene.length()).largest(), errorBound(entry)) << method->name();
      }
    }
  }
}

TEST(Methods, ForgetTheirHistoryOnReset) {
  const Scene scene = paperScene(2);
  const std::vector<Pressures> path = pressurePath(2);
  for (const MethodEntry& entry : methodList()) {
    const StiffnessSolution fresh = entry.make(scene)->solve(path[0]);
    const std::unique_ptr<StiffnessMethod> method = entry.make(scene);
    ASSERT_TRUE(method->solve(path[40]).status.ok()) << method->name();
    method->reset();
    const StiffnessSolution again = method->solve(path[0]);
    EXPECT_EQ(again.X_BT.p, fresh.X_BT.p) << method->name();
    EXPECT_EQ(again.compliance, fresh.compliance) << method->name();
  }
}

using Solve = std::function<StiffnessSolution(int resolution)>;

// Binary logarithm of the errors' ratio between two resolutions, the finer twice the coarser.
SolutionErrors orders(const Solve& solve, int coarse, const StiffnessSolution& exact, double length) {
  const SolutionErrors a = errorsOf(solve(coarse), exact, length), b = errorsOf(solve(2 * coarse), exact, length);
  return {std::log2(a.pose / b.pose), std::log2(a.tangent / b.tangent), std::log2(a.material / b.material)};
}

TEST(Methods, ConvergeAtTheOrderOfTheirName) {
  constexpr double kMargin = 0.4;  // the next terms of the error, at these coarse resolutions
  for (int segments : {1, 2}) {
    const Scene scene = paperScene(segments);
    const Pressures pressures = pressurePath(segments)[64];
    const StiffnessSolution exact = solveCold(StiffnessModel(scene, accurateTo(1e-12)), pressures);
    const auto expectOrder = [&](double order, int coarse, const Solve& solve) {
      const SolutionErrors measured = orders(solve, coarse, exact, scene.length());
      EXPECT_NEAR(measured.pose, order, kMargin);
      EXPECT_NEAR(measured.tangent, order, kMargin);
      EXPECT_NEAR(measured.material, order, kMargin);
    };
    expectOrder(4.0, 10, [&](int n) { return Rk4Sensitivities(scene, n).solve(pressures); });
    expectOrder(4.0, 2, [&](int n) { return Magnus<2>(scene, n).solve(pressures); });
    expectOrder(6.0, 4, [&](int n) { return Magnus<3>(scene, n).solve(pressures); });
    // Finite differences spoil the tangent, not the shape.
    const SolutionErrors common = orders(
        [&](int n) { return CommonPractice(scene, CommonPractice::Jacobians::kFresh, n).solve(pressures); }, 10, exact,
        scene.length());
    EXPECT_NEAR(common.pose, 4.0, kMargin);
    EXPECT_NEAR(common.material, 4.0, kMargin);
    const SolutionErrors minimum =
        orders([&](int n) { return EnergyMinimum(scene, n).solve(pressures); }, 8, exact, scene.length());
    EXPECT_NEAR(minimum.pose, 2.0, kMargin);
    EXPECT_NEAR(minimum.tangent, 2.0, kMargin);
  }
}

// Links, a tip off the axis and oblique gravity, from cold and from the last solution.
TEST(Methods, MinimiseTheEnergyOfAnyChain) {
  const Scene scene = awkwardScene();
  const std::vector<Pressures> path = pressurePath(2);
  const std::vector<StiffnessSolution> exact = exactSolutions(scene, path);
  EnergyMinimum method(scene, 64);
  for (size_t i = 0; i < path.size(); i += 16) {
    const StiffnessSolution solution = method.solve(path[i]);
    ASSERT_TRUE(solution.status.ok()) << i;
    const SolutionErrors errors = errorsOf(solution, exact[i], scene.length());
    EXPECT_LT(std::max(errors.pose, errors.tangent), 1e-3) << i;  // 64^-2 and a constant
  }
}

}  // namespace
}  // namespace live_stiffness
