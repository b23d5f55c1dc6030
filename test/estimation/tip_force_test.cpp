#include "estimation/tip_force.h"

#include <gtest/gtest.h>

#include <random>

#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {
namespace {

class TipForceTest : public ::testing::Test {
 protected:
  StiffnessSolution solve(const Vector3& force) {
    Wrench wrench = Wrench::Zero();
    wrench.head<3>() = force;
    return model_.solve(pressures_, wrench, workspace_);
  }

  StiffnessModel model_{loadSceneFile(std::string(SOURCE_DIR) + "/config/scenes/paper_one_segment.yaml"), ModelOptions()};
  StiffnessWorkspace workspace_ = model_.makeWorkspace();
  Pressures pressures_ = (Pressures(6) << 80e3, 80e3, 0.0, 0.0, 20e3, 20e3).finished();
};

TEST_F(TipForceTest, RecoversAForceFromTheResolvedTipUpToItsSquare) {
  const StiffnessSolution free = solve(Vector3::Zero());
  const auto relative_error = [&](const Vector3& force) {
    const Twist residual = residualTwist(solve(force).X_BT, free.X_BT);
    return (estimateTipForce(free.compliance, residual).force - force).norm() / force.norm();
  };
  const Vector3 force(1e-3, -2e-3, 3e-3);
  const double full = relative_error(force), tenth = relative_error(0.1 * force);
  // A linear estimate errs by the square of the force, so the relative error is proportional to it; the third order
  // moves the ratio of ten by a few per cent.
  EXPECT_NEAR(full / tenth, 10.0, 1.0);
  EXPECT_LT(full, 0.03) << "3.7 mN deflect this 40 mm robot by about 0.1 mm";
}

TEST_F(TipForceTest, CovarianceIsThatOfManyNoisyMeasurements) {
  const StiffnessSolution free = solve(Vector3::Zero());
  const TrackerNoise noise;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Matrix3 scatter = Matrix3::Zero();
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    Twist residual;
    for (int k = 0; k < 6; ++k) residual[k] = normal(random) * (k < 3 ? noise.position : noise.rotation);
    const Vector3 force = estimateTipForce(free.compliance, residual, noise).force;
    scatter += force * force.transpose() / kCount;
  }
  const Matrix3 covariance = estimateTipForce(free.compliance, Twist::Zero(), noise).covariance;
  // The scatter of a sample covariance is sqrt(2 / count), 1 %; 5 % is far beyond it.
  EXPECT_LT((scatter - covariance).norm(), 0.05 * covariance.norm());
}

TEST(ResidualTwist, TakesThePredictedPoseToTheMeasuredOne) {
  const Pose predicted{expSo3(Vector3(0.3, 0.2, -0.5)), Vector3(0.01, 0.02, 0.03)};
  const Vector3 turn(0.02, -0.01, 0.03);
  const Pose measured{expSo3(turn) * predicted.R, predicted.p + Vector3(1e-3, 0.0, -2e-3)};
  const Twist residual = residualTwist(measured, predicted);
  EXPECT_LT((residual.head<3>() - Vector3(1e-3, 0.0, -2e-3)).norm(), 1e-16);
  EXPECT_LT((residual.tail<3>() - turn).norm(), 1e-15);
}

}  // namespace
}  // namespace live_stiffness
