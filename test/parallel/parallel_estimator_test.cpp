#include "parallel/parallel_estimator.h"

#include <gtest/gtest.h>

#include <limits>

#include "parallel/parallel_cases.h"
#include "support/errors.h"

namespace live_stiffness {
namespace {

const Wrench kPush = (Wrench() << 1.0, -0.5, 0.2, 0.0, 0.01, 0.0).finished();

TEST(ParallelEstimator, IsTheModelForLengthsAndWrench) {
  ParallelEstimator estimator(awkwardRobot(), ParallelOptions());
  EXPECT_FALSE(estimator.setWrench(kPush)) << "no lengths yet";
  ASSERT_TRUE(estimator.setLengths(unevenLengths()));
  const ParallelSolution expected = solveCold(estimator.model(), unevenLengths(), kPush);
  const ParallelEstimate& estimate = *estimator.estimate();
  EXPECT_LT(poseError(estimate.solution.X_BP, expected.X_BP, 0.4), 1e-9);
  EXPECT_LT((estimate.stiffness * expected.compliance - Matrix6::Identity()).norm(), 1e-5);
  EXPECT_EQ(estimate.lengths, unevenLengths());
  EXPECT_EQ(estimate.wrench, kPush);
  EXPECT_FALSE(estimator.setLengths(unevenLengths())) << "nothing new";
  EXPECT_TRUE(estimator.setWrench(Wrench::Zero()));
}

// From each hole to where the platform holds the rod, and as long as it is said to be: chords of 24 pieces of a gentle
// arc are short by less than 1e-4.
TEST(ParallelEstimator, RodsRunFromBaseToPlatform) {
  ParallelEstimator estimator(awkwardRobot(), ParallelOptions());
  ASSERT_TRUE(estimator.setLengths(unevenLengths()));
  const ParallelEstimate& estimate = *estimator.estimate();
  ASSERT_EQ(estimate.rods.size(), 6u);
  for (size_t i = 0; i < 6; ++i) {
    const ParallelRod& rod = estimator.model().scene().rods[i];
    const std::vector<Pose>& shape = estimate.rods[i];
    EXPECT_LT(poseError(shape.front(), rod.X_BD, 0.4), 1e-12);
    EXPECT_LT(poseError(shape.back(), estimate.solution.X_BP * rod.X_PE, 0.4), 1e-7);
    double length = 0.0;
    for (size_t k = 1; k < shape.size(); ++k) length += (shape[k].p - shape[k - 1].p).norm();
    EXPECT_NEAR(length, unevenLengths()[i], 1e-4 * length);
  }
}

TEST(ParallelEstimator, KeepsTheLastGoodEstimateAndRecovers) {
  ParallelEstimator estimator(stewartGough(), ParallelOptions());
  EXPECT_EQ(estimator.estimate(), nullptr);
  ASSERT_TRUE(estimator.setLengths(unevenLengths()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<double>> bad_lengths = {
      {0.4, 0.4, 0.4}, {0.4, 0.4, nan, 0.4, 0.4, 0.4}, {0.4, 0.4, 0.4, 0.4, 0.4, -1.0}, {0.1, 0.9, 0.1, 0.9, 0.1, 0.9}};
  for (const std::vector<double>& bad : bad_lengths) {
    EXPECT_FALSE(estimator.setLengths(bad));
    EXPECT_FALSE(estimator.status().ok());
    EXPECT_FALSE(estimator.statusText().empty());
    ASSERT_NE(estimator.estimate(), nullptr);
    EXPECT_EQ(estimator.estimate()->lengths, unevenLengths());
  }
  std::vector<double> others = unevenLengths();
  others[1] += 0.01;
  EXPECT_TRUE(estimator.setLengths(others));
  EXPECT_TRUE(estimator.status().ok());
}

}  // namespace
}  // namespace live_stiffness
