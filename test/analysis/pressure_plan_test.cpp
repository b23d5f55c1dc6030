#include "analysis/pressure_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

// Of the first chamber of each of three channels in a row.
Vector3 channels(const PressurePlan& plan, long row) {
  Pressures chambers(plan.channels().chamberCount());
  plan.chamberPressures(row, chambers);
  const long pair = chambers.size() / 3;
  return {chambers[0], chambers[pair], chambers[2 * pair]};
}

TEST(PressureGrid, VisitsEveryCombinationOnceWithBothEnds) {
  const PressurePlan plan = PressurePlan::grid({{0.0, 1e5, 3}, {-1e4, 2e4, 4}, {5e4, 9e4, 1}}, ChannelMap::even(3, 6));
  ASSERT_EQ(plan.rows(), 12);
  std::set<std::vector<double>> seen;
  for (long row = 0; row < plan.rows(); ++row) {
    const Vector3 p = channels(plan, row);
    seen.insert({p[0], p[1], p[2]});
    Pressures chambers(6);
    plan.chamberPressures(row, chambers);
    EXPECT_EQ(chambers, plan.channels().expand(Pressures(p)));
  }
  EXPECT_EQ(seen.size(), 12u);
  EXPECT_EQ(channels(plan, 0), Vector3(0.0, -1e4, 5e4));
  EXPECT_EQ(channels(plan, 1), Vector3(0.0, 0.0, 5e4));  // the last channel with a choice is the fastest
  EXPECT_EQ(channels(plan, 11), Vector3(1e5, 2e4, 5e4));
}

TEST(PressureSample, DependsOnSeedAndRowAloneAndFillsTheRange) {
  const auto sample = [](std::uint64_t seed) {
    return PressurePlan::sample({{-1e4, 3e4, 1}}, ChannelMap::even(3, 3), 20000, seed);
  };
  const PressurePlan a = sample(7), b = sample(7), c = sample(8);
  Vector3 mean = Vector3::Zero(), least = Vector3::Constant(1e9), most = -least;
  for (long row = a.rows() - 1; row >= 0; --row) {
    const Vector3 p = channels(a, row);
    EXPECT_EQ(p, channels(b, row));
    EXPECT_NE(p, channels(c, row));
    mean += p / a.rows();
    least = least.cwiseMin(p);
    most = most.cwiseMax(p);
  }
  // Of 20000 draws the mean is good to 4e4 / sqrt(12 * 20000) = 82, a fifth of what is asked; ends to 4e4 / 20000.
  EXPECT_LT((mean.array() - 1e4).abs().maxCoeff(), 400.0);
  EXPECT_LT((least.array() + 1e4).maxCoeff(), 40.0);
  EXPECT_GT((most.array() - 3e4).minCoeff(), -40.0);
  EXPECT_GE(least.minCoeff(), -1e4);
  EXPECT_LE(most.maxCoeff(), 3e4);
}

TEST(PressurePlan, RefusesWhatMakesNoSense) {
  const ChannelMap map = ChannelMap::even(3, 6);
  EXPECT_THROW(PressurePlan::grid({}, map), ConfigurationError);
  EXPECT_THROW(PressurePlan::grid({{0, 1, 2}, {0, 1, 2}}, map), ConfigurationError);
  EXPECT_THROW(PressurePlan::grid({{0, 1e5, 0}}, map), ConfigurationError);
  EXPECT_THROW(PressurePlan::grid({{-2e5, 1e5, 3}}, map), ConfigurationError);
  EXPECT_THROW(PressurePlan::grid({{0, std::nan(""), 3}}, map), ConfigurationError);
  EXPECT_THROW(PressurePlan::grid({{0, 1e5, 2000}}, map), ConfigurationError);  // 8e9 rows
  EXPECT_THROW(PressurePlan::sample({{0, 1e5, 1}}, map, 0, 1), ConfigurationError);
}

}  // namespace
}  // namespace live_stiffness
