#include "analysis/stiffness_finder.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <iostream>

#include "live_stiffness/checks.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

ModelOptions smooth() {
  ModelOptions options = accurateTo(1e-10);
  options.stepping = Stepping::kContinuous;
  return options;
}

// Two segments, six channels, three of them left over: nothing found by projecting random pressures onto the point is
// stiffer than the stiffest or softer than the softest. The search shares only the model.
TEST(StiffnessFinder, IsNotBeatenByRandomPressuresThatReachTheSamePoint) {
  const StiffnessModel model(paperScene(2), smooth());
  const ChannelMap channels = ChannelMap::even(6, 12);
  const Vector3 point(0.01, 0.005, 0.095);
  FinderOptions options;
  options.starts = 8;
  const FinderResult result = findPressures(model, channels, point, Vector3::UnitX(), options);
  ASSERT_TRUE(result.reached);
  for (const FoundPressures& found : {result.stiffest, result.softest}) {
    EXPECT_LE(found.miss, options.tolerance);
    EXPECT_GE(found.channels.minCoeff(), 0.0);
    EXPECT_LE(found.channels.maxCoeff(), options.max_pressure);
    const StiffnessSolution again = solveCold(model, channels.expand(found.channels));
    ASSERT_TRUE(again.status.ok());
    EXPECT_NEAR((again.X_BT.p - point).norm(), found.miss, 1e-9);
    EXPECT_NEAR(1.0 / again.compliance(0, 0) / found.stiffness, 1.0, 1e-7);
  }
  EXPECT_GT(result.stiffest.stiffness, 2.0 * result.softest.stiffness);

  RandomSource random(5);
  int reached = 0;
  double least = 1e9, most = 0.0;
  for (int draw = 0; draw < 300; ++draw) {
    Pressures p(6);
    for (int k = 0; k < 6; ++k) p[k] = random.uniform(0.0, options.max_pressure);
    for (int i = 0; i < 15; ++i) {  // Newton's method on the point, shortest steps, by forward differences
      const StiffnessSolution at = solveCold(model, channels.expand(p));
      if (!at.status.ok()) break;
      const Vector3 miss = point - at.X_BT.p;
      if (miss.norm() < 1e-6) {
        ++reached;
        most = std::max(most, 1.0 / at.compliance(0, 0));
        least = std::min(least, 1.0 / at.compliance(0, 0));
        break;
      }
      Eigen::Matrix<double, 3, 6> J;
      bool good = true;
      for (int k = 0; k < 6; ++k) {
        Pressures moved = p;
        moved[k] += 10.0;
        const StiffnessSolution there = solveCold(model, channels.expand(moved));
        good = good && there.status.ok();
        J.col(k) = (there.X_BT.p - at.X_BT.p) / 10.0;
      }
      if (!good) break;
      p = (p + J.completeOrthogonalDecomposition().solve(miss)).cwiseMax(0.0).cwiseMin(options.max_pressure);
    }
  }
  EXPECT_GT(reached, 50);
  EXPECT_LE(most, result.stiffest.stiffness * (1.0 + 1e-4));
  EXPECT_GE(least, result.softest.stiffness * (1.0 - 1e-4));
  std::cout << "found " << result.softest.stiffness << " to " << result.stiffest.stiffness << " N/m, " << reached
            << " random ones " << least << " to " << most << "\n";
}

TEST(StiffnessFinder, SaysThatAPointIsOutOfReachAndHowNearItGets) {
  const StiffnessModel model(paperScene(1), smooth());
  FinderOptions options;
  options.starts = 6;
  const ChannelMap channels = ChannelMap::even(3, 6);
  // Straight up, beyond full pressure: the nearest point is that of full pressure in all.
  const StiffnessSolution full = solveCold(model, Pressures::Constant(6, options.max_pressure));
  const FinderResult result = findPressures(model, channels, Vector3(0.0, 0.0, 0.2), Vector3::UnitZ(), options);
  ASSERT_TRUE(result.solvable);
  EXPECT_FALSE(result.reached);
  EXPECT_NEAR(result.nearest.miss, 0.2 - full.X_BT.p.z(), 1e-5);
}

// One segment: three channels for three coordinates leave no choice.
TEST(StiffnessFinder, FindsThePressuresOfAPointThatWasReachedByThem) {
  const StiffnessModel model(paperScene(1), smooth());
  const ChannelMap channels = ChannelMap::even(3, 6);
  const Vector3 known(0.3e5, 0.8e5, 0.1e5);
  const StiffnessSolution there = solveCold(model, channels.expand(known));
  FinderOptions options;
  options.starts = 6;
  options.tolerance = 1e-6;
  const FinderResult result = findPressures(model, channels, there.X_BT.p, Vector3::UnitX(), options);
  ASSERT_TRUE(result.reached);
  EXPECT_LT((result.stiffest.channels - known).norm(), 200.0);
  EXPECT_NEAR(result.stiffest.stiffness / result.softest.stiffness, 1.0, 1e-3);
}

TEST(StiffnessFinder, RefusesBadQuestionsAllAtOnce) {
  const StiffnessModel model(paperScene(1), smooth());
  FinderOptions options;
  options.max_pressure = 0.0;
  options.tolerance = std::nan("");
  try {
    findPressures(model, ChannelMap::even(3, 12), Vector3(0.0, std::nan(""), 0.0), Vector3::Zero(), options);
    FAIL() << "searched";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.faults().size(), 5u) << error.what();
  }
}

}  // namespace
}  // namespace live_stiffness
