#include "live_stiffness/analysis/deflection.h"

#include <gtest/gtest.h>

#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

const Pressures kPressures = bars(0.8, {1, 1, 0.3, 0.3, 0, 0});
const Wrench kPush = (Wrench() << 0.05, -0.03, 0.02, 1e-4, -2e-4, 1e-4).finished();

TEST(Deflection, ExponentialIsEquation19FromTheBaseToo) {
  const StiffnessSolution solution = solveCold(StiffnessModel(paperScene(1), {}), kPressures);
  const PredictedDeflection found = predictDeflection(solution.X_BT, solution.compliance, kPush);
  // e^(Delta T^o) g_c with the twist about the base origin.
  const Twist about_base = twistShift(-solution.X_BT.p) * found.twist;
  const Pose expected = expSe3(linear(about_base), angular(about_base), 1.0) * solution.X_BT;
  EXPECT_LT(poseError(found.exponential, expected, 0.04), 1e-13);
}

// Both predictions are right to first order: a tenth of the push leaves a hundredth of the error.
TEST(Deflection, ErrsBySecondOrderInThePush) {
  const StiffnessModel model(paperScene(2), accurateTo(1e-12));
  StiffnessWorkspace workspace = model.makeWorkspace();
  Pressures pressures(12);
  pressures << kPressures, 0.5 * kPressures;
  const Wrench before = (Wrench() << 0.01, 0.0, 0.0, 0, 0, 0).finished();
  const DeflectionCheck large = checkDeflection(model, pressures, before, 0.1 * kPush, workspace);
  const DeflectionCheck small = checkDeflection(model, pressures, before, 0.01 * kPush, workspace);
  ASSERT_TRUE(large.status.ok() && small.status.ok());
  for (auto error : {&DeflectionCheck::linear_error, &DeflectionCheck::exponential_error}) {
    EXPECT_GT((large.*error).position, 50.0 * (small.*error).position);
    EXPECT_LT((large.*error).position, 200.0 * (small.*error).position);
    EXPECT_LT((small.*error).position, 0.01 * linear(small.predicted.twist).norm());
  }
}

TEST(Deflection, OfNoPushIsNone) {
  const StiffnessModel model(paperScene(1), {});
  StiffnessWorkspace workspace = model.makeWorkspace();
  const DeflectionCheck check = checkDeflection(model, kPressures, Wrench::Zero(), Wrench::Zero(), workspace);
  ASSERT_TRUE(check.status.ok());
  EXPECT_LT(check.exponential_error.position, 1e-9);
  EXPECT_LT(check.linear_error.rotation, 1e-8);
}

TEST(Deflection, AFailingSolveIsAStatus) {
  const StiffnessModel model(paperScene(1), {});
  StiffnessWorkspace workspace = model.makeWorkspace();
  const DeflectionCheck huge = checkDeflection(model, kPressures, Wrench::Zero(), 1e9 * kPush, workspace);
  EXPECT_TRUE(huge.undeflected_ok);
  EXPECT_FALSE(huge.status.ok());
  const DeflectionCheck bad = checkDeflection(model, bars(9.0, {1, 1, 1, 1, 1, 1}), Wrench::Zero(), kPush, workspace);
  EXPECT_FALSE(bad.undeflected_ok);
  EXPECT_EQ(bad.status.code, SolveCode::kOutOfRange);
}

}  // namespace
}  // namespace live_stiffness
