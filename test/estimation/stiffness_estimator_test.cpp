#include "live_stiffness/estimation/stiffness_estimator.h"

#include <gtest/gtest.h>

#include <limits>

#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {
namespace {

using Outcome = StiffnessEstimator::Outcome;

class StiffnessEstimatorTest : public ::testing::Test {
 protected:
  StiffnessEstimator estimator_{loadSceneFile(std::string(SOURCE_DIR) + "/config/scenes/paper_one_segment.yaml"),
                                ModelOptions(), EstimatorOptions()};
  Pressures pressures_ = Pressures::Constant(6, 20e3);
};

TEST_F(StiffnessEstimatorTest, SolvesOnlyWhenPressuresMoveByMoreThanTheThreshold) {
  EXPECT_EQ(estimator_.setPressures(pressures_), Outcome::kSolved);
  EXPECT_EQ(estimator_.setPressures(pressures_), Outcome::kUnchanged);
  Pressures near = pressures_;
  near[0] += 999.0;
  EXPECT_EQ(estimator_.setPressures(near), Outcome::kUnchanged);
  EXPECT_EQ(estimator_.estimate()->pressures, pressures_);
  // Small changes add up: the threshold counts from the last solve, not from the last message.
  near[1] += 999.0;
  EXPECT_EQ(estimator_.setPressures(near), Outcome::kSolved);
  EXPECT_EQ(estimator_.estimate()->pressures, near);
}

Scene creepingScene(double share) {
  Scene scene = loadSceneFile(std::string(SOURCE_DIR) + "/config/scenes/paper_one_segment.yaml");
  Material& material = std::get<Segment>(scene.chain.front()).section.material;
  material.creep_share = share;
  material.creep_time = 2.0;
  return scene;
}

TEST(StiffnessEstimatorCreep, AStepOfPressureActsLaterByTheScenesShareAndIsThenThatOfARobotWithout) {
  StiffnessEstimator creeping(creepingScene(0.1), ModelOptions(), EstimatorOptions());
  StiffnessEstimator relaxed(creepingScene(0.0), ModelOptions(), EstimatorOptions());
  const Pressures rest = Pressures::Zero(6);
  Pressures step = rest;
  step.head(2).setConstant(60e3);
  creeping.setPressures(rest, 100.0);
  creeping.setPressures(step, 100.0);
  relaxed.setPressures(0.9 * step, 100.0);
  EXPECT_EQ(creeping.estimate()->pressures, step);
  EXPECT_LT((creeping.estimate()->effective - 0.9 * step).norm(), 1e-9);
  EXPECT_LT((creeping.estimate()->solution.X_BT.p - relaxed.estimate()->solution.X_BT.p).norm(), 1e-9);
  relaxed.setPressures(step, 101.0);
  const Vector3 settled = relaxed.estimate()->solution.X_BT.p;
  double last = (creeping.estimate()->solution.X_BT.p - settled).norm();
  EXPECT_GT(last, 1e-3);
  for (int k = 1; k <= 400; ++k) {  // ten time constants
    creeping.setPressures(step, 100.0 + 0.05 * k);
    const double distance = (creeping.estimate()->solution.X_BT.p - settled).norm();
    EXPECT_LE(distance, last);
    last = distance;
  }
  // The threshold of 1 kPa in the 2-norm is 1.2 % of the step's, which moves the tip by about as much of its way.
  EXPECT_LT(last, 1e-3);
}

TEST(StiffnessEstimatorCreep, RefusedPressuresLeaveNoTraceInIt) {
  StiffnessEstimator creeping(creepingScene(0.1), ModelOptions(), EstimatorOptions());
  const Pressures pressures = Pressures::Constant(6, 20e3);
  creeping.setPressures(pressures, 1.0);
  const Pressures unknown = Pressures::Constant(6, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(creeping.setPressures(unknown, 1.1), Outcome::kFailed);
  EXPECT_EQ(creeping.setPressures(Pressures::Constant(3, 1e3), 1.2), Outcome::kFailed);
  EXPECT_EQ(creeping.setPressures(pressures, 1.3), Outcome::kSolved);
  EXPECT_EQ(creeping.estimate()->effective, pressures);
}

TEST_F(StiffnessEstimatorTest, SolvesOnAChangedTipWrench) {
  EXPECT_EQ(estimator_.setTipWrench(Wrench::Zero()), Outcome::kUnchanged) << "no pressures yet";
  estimator_.setPressures(pressures_);
  const double z = estimator_.estimate()->solution.X_BT.p.z();
  Wrench pull = Wrench::Zero();
  pull[2] = 0.1;
  EXPECT_EQ(estimator_.setTipWrench(pull), Outcome::kSolved);
  EXPECT_GT(estimator_.estimate()->solution.X_BT.p.z(), z);
  EXPECT_EQ(estimator_.setTipWrench(pull), Outcome::kUnchanged);
}

TEST_F(StiffnessEstimatorTest, KeepsTheLastGoodEstimateWhenASolveFails) {
  EXPECT_EQ(estimator_.estimate(), nullptr);
  estimator_.setPressures(pressures_);
  const Pose good = estimator_.estimate()->shape.back().X_BQ;
  for (const Pressures& bad : {Pressures(Pressures::Constant(6, 5e5)), Pressures(Pressures::Constant(3, 1e3)),
                               Pressures(Pressures::Constant(6, std::numeric_limits<double>::quiet_NaN()))}) {
    EXPECT_EQ(estimator_.setPressures(bad), Outcome::kFailed);
    EXPECT_FALSE(estimator_.status().ok());
    EXPECT_FALSE(estimator_.statusText().empty());
    ASSERT_NE(estimator_.estimate(), nullptr);
    EXPECT_EQ(estimator_.estimate()->pressures, pressures_);
    EXPECT_EQ(estimator_.estimate()->shape.back().X_BQ.p, good.p) << "the failed shape must not be shown";
  }
  EXPECT_EQ(estimator_.setPressures(pressures_), Outcome::kSolved);
  EXPECT_TRUE(estimator_.statusText().empty());
}

TEST_F(StiffnessEstimatorTest, StiffnessIsTheInverseAndStationsAreWhereTheyWereAsked) {
  estimator_.setPressures(pressures_);
  const Estimate& estimate = *estimator_.estimate();
  // Conditioning of the compliance in SI units is about 1e4.
  EXPECT_LT((estimate.stiffness * estimate.solution.compliance - Matrix6::Identity()).norm(), 1e-11);
  ASSERT_EQ(estimate.stations.size(), 5u);
  const Station& last = estimate.stations.back();  // fraction 1; the tip point has no offset in this scene
  EXPECT_LT((last.X_BQ.p - estimate.solution.X_BT.p).norm(), 1e-15);
  EXPECT_LT((last.compliance - estimate.solution.material_compliance).norm(), 1e-12 * last.compliance.norm());
}

TEST_F(StiffnessEstimatorTest, ShapeIsThatOfTheSolution) {
  StiffnessEstimator two(loadSceneFile(std::string(SOURCE_DIR) + "/config/scenes/paper_two_segments.yaml"),
                         ModelOptions(), EstimatorOptions());
  Pressures pressures(12);
  pressures << 60e3, 60e3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 40e3, 40e3, 0.0, 0.0;
  two.setPressures(pressures);
  const StiffnessModel& model = two.model();
  StiffnessWorkspace workspace = model.makeWorkspace();
  model.solve(pressures, Wrench::Zero(), workspace);
  const std::vector<Station> expected = sampleBackbone(model, workspace, kShapeSections);
  const std::vector<Station>& shape = two.estimate()->shape;
  ASSERT_EQ(shape.size(), 2u * (kShapeSections + 1));
  ASSERT_EQ(shape.size(), expected.size());
  EXPECT_EQ(shape.front().X_BQ.p.norm(), 0.0);
  for (size_t i = 0; i < shape.size(); ++i) {
    // Two solves from different starts, each to the model's accuracy of 1e-9.
    EXPECT_LT((shape[i].X_BQ.p - expected[i].X_BQ.p).norm(), 1e-9) << i;
    EXPECT_LT((shape[i].compliance - expected[i].compliance).norm(), 1e-8 * (1e-3 + expected[i].compliance.norm())) << i;
  }
}

TEST(StiffnessEstimatorOptions, AllFaultsAreReported) {
  EstimatorOptions options;
  options.update_threshold = -1.0;
  options.fractions = {0.5, 1.5, std::numeric_limits<double>::quiet_NaN()};
  try {
    StiffnessEstimator estimator(loadSceneFile(std::string(SOURCE_DIR) + "/config/scenes/paper_one_segment.yaml"),
                                 ModelOptions(), options);
    FAIL() << "must throw";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.faults().size(), 3u) << error.what();
  }
}

}  // namespace
}  // namespace live_stiffness
