#include "live_stiffness/analysis/holding_wrench.h"

#include <gtest/gtest.h>

#include <limits>

#include "rod/backbone.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

const Pressures kPressures = bars(0.3, {1, 1, 0.3, 0.3, 0, 0});
const Wrench kActing = (Wrench() << 0.01, 0.0, -0.01, 0, 0, 0).finished();

Pressures pressuresOf(const Scene& scene) {
  Pressures pressures(scene.chamberCount());
  for (int k = 0; k < pressures.size(); ++k) pressures[k] = (k / 6 == 0 ? 1.0 : 0.5) * kPressures[k % 6];
  return pressures;
}

HoldingWrench hold(const Scene& scene, const HoldGoal& goal, const Wrench& acting = kActing) {
  const StiffnessModel model(scene, accurateTo(1e-11));
  StiffnessWorkspace workspace = model.makeWorkspace();
  return findHoldingWrench(model, pressuresOf(scene), acting, goal, workspace);
}

Pose poseUnder(const Scene& scene, const Wrench& wrench) {
  return solveCold(StiffnessModel(scene, accurateTo(1e-11)), pressuresOf(scene), wrench).X_BT;
}

// The goal comes from a solve under a known wrench; the search must find just that wrench. Error of the wrench: that of
// the goal, 1e-7 of the length, times the stiffness, over the wrench. Wrenches as large as each scene stands on a
// straight way: two segments under their own weight are near to giving way.
TEST(HoldingWrench, FindsTheWrenchThatAGoalWasMadeWith) {
  RandomSource random(3);
  const std::vector<std::pair<Scene, double>> cases = {
      {paperScene(1), 0.06}, {paperScene(2), 0.01}, {weightlessPaperScene(2), 0.03}, {awkwardScene(), 0.01}};
  for (const auto& [scene, size] : cases)
    for (int i = 0; i < 5; ++i) {
      const Wrench force = random.wrench(size, 0.0), full = random.wrench(0.6 * size, 0.01 * size);
      const Pose pulled = poseUnder(scene, kActing + force), twisted = poseUnder(scene, kActing + full);
      const HoldingWrench of_force = hold(scene, {pulled.p, std::nullopt});
      ASSERT_TRUE(of_force.reached) << "missed by " << of_force.miss.position << " m";
      EXPECT_LT((of_force.wrench - force).norm(), 1e-4 * force.norm());
      EXPECT_EQ(angular(of_force.wrench).norm(), 0.0);
      const HoldingWrench of_wrench = hold(scene, {twisted.p, twisted.R});
      ASSERT_TRUE(of_wrench.reached) << "missed by " << of_wrench.miss.position << " m";
      EXPECT_LT(linear(of_wrench.wrench - full).norm(), 1e-4 * linear(full).norm());
      EXPECT_LT(angular(of_wrench.wrench - full).norm(), 1e-4 * angular(full).norm());
    }
}

// Far from where one Newton step would lead; the answer is checked by a solve of its own.
TEST(HoldingWrench, HoldsTheTipFarFromWhereItIs) {
  const Scene scene = paperScene(1);
  const Pose before = poseUnder(scene, kActing);
  for (const Vector3& way : {Vector3(0.015, 0, 0), Vector3(-0.01, 0.01, 0.002), Vector3(0, -0.01, 0.01)}) {
    const HoldGoal goal{before.p + way, std::nullopt};
    const HoldingWrench found = hold(scene, goal);
    ASSERT_TRUE(found.reached) << "missed by " << found.miss.position << " m";
    EXPECT_LT((poseUnder(scene, kActing + found.wrench).p - goal.position).norm(), 1e-8);
    const PredictedDeflection linearly = predictDeflection(found.before.X_BT, found.before.compliance, found.wrench);
    EXPECT_GT((linearly.linear.p - goal.position).norm(), 1e-3) << "so far that the linear answer would not do";
  }
}

TEST(HoldingWrench, IsNoneWhereTheTipIsAlready) {
  const Pose there = poseUnder(paperScene(1), kActing);
  const HoldingWrench found = hold(paperScene(1), {there.p, there.R});
  EXPECT_TRUE(found.reached);
  EXPECT_EQ(found.wrench.norm(), 0.0);
  EXPECT_EQ(found.solves, 1);
}

// Straight down onto the axis of a symmetric column: it buckles first.
TEST(HoldingWrench, SaysWhereNoStableEquilibriumLeads) {
  const StiffnessModel model(paperScene(1), {});
  StiffnessWorkspace workspace = model.makeWorkspace();
  const HoldingWrench found = findHoldingWrench(model, Pressures::Zero(6), Wrench::Zero(),
                                                {Vector3(0.0, 0.0, 0.015), std::nullopt}, workspace);
  EXPECT_FALSE(found.reached);
  ASSERT_TRUE(found.before.status.ok());
  ASSERT_TRUE(found.held.status.ok());
  EXPECT_GT(found.miss.position, 0.005);
  EXPECT_LT((found.held.X_BT.p - workspace.backbone().X_BT.p).norm(), 1e-9) << "the workspace must be at `held`";
  EXPECT_LE(found.solves, 70);
}

TEST(HoldingWrench, BadInputIsAStatusOrNotReached) {
  const StiffnessModel model(paperScene(1), {});
  StiffnessWorkspace workspace = model.makeWorkspace();
  const HoldingWrench beyond =
      findHoldingWrench(model, bars(9.0, {1, 1, 1, 1, 1, 1}), Wrench::Zero(), HoldGoal(), workspace);
  EXPECT_EQ(beyond.before.status.code, SolveCode::kOutOfRange);
  EXPECT_FALSE(beyond.reached);
  const Vector3 nowhere = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(findHoldingWrench(model, kPressures, Wrench::Zero(), {nowhere, std::nullopt}, workspace).reached);
}

}  // namespace
}  // namespace live_stiffness
