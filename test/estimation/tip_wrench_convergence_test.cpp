// The filter finds the force after a drop-out during which a push began: the tip is suddenly far from where it was.

#include <gtest/gtest.h>

#include <random>

#include "live_stiffness/estimation/tip_wrench_estimator.h"
#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {
namespace {

TEST(TipWrenchConvergence, FindsAPushThatBeganDuringADropOut) {
  const Scene scene = loadSceneFile(SOURCE_DIR "/config/scenes/paper_one_segment.yaml");
  ModelOptions options;
  options.stepping = Stepping::kContinuous;
  const StiffnessModel model(scene, options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  // An NDI Aurora's 0.48 mm and 0.30 deg, taken as the length of the error; per axis.
  const double position_noise = 0.48e-3 / std::sqrt(3.0), rotation_noise = radians(0.30) / std::sqrt(3.0);  // an Aurora
  const auto white = [&](double sigma) {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vector3(sigma * x, sigma * y, sigma * z);
  };
  int tried = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Pressures pressures(6);
    for (int pair = 0; pair < 3; ++pair) pressures[2 * pair] = pressures[2 * pair + 1] = 60e3 * uniform(random);
    Wrench push = Wrench::Zero();
    const double azimuth = 2.0 * kPi * uniform(random), size = 0.2 + 0.3 * uniform(random);
    linear(push) = size * Vector3(std::cos(azimuth), std::sin(azimuth), 0.0);
    const Pose free = model.solve(pressures, Wrench::Zero(), workspace).X_BT;
    const StiffnessSolution pushed = model.solve(pressures, push, workspace);
    if (!pushed.status.ok()) continue;
    TipWrenchEstimator estimator(scene, options, TipWrenchOptions());
    double time = 0.0;
    const auto see = [&](const Pose& X, int samples) {
      for (int k = 0; k < samples; ++k, time += 0.025)
        estimator.update(pressures, {X.R * expSo3(white(rotation_noise)), X.p + white(position_noise)}, time);
    };
    see(free, 40);
    time += 0.5;
    see(pushed.X_BT, 20);
    ++tried;
    const TipWrenchEstimate* estimate = estimator.estimate();
    ASSERT_NE(estimate, nullptr);
    const Vector3 error = linear(estimate->wrench) - linear(push);
    const Vector3 deviation = estimate->covariance.diagonal().head<3>().cwiseSqrt();
    // Four standard deviations of what the filter itself claims, and 20 % for what it counts as model error.
    for (int k = 0; k < 3; ++k)
      EXPECT_LT(std::abs(error[k]), 4.0 * deviation[k] + 0.2 * size)
          << "trial " << trial << ", force " << push.head<3>().transpose() << ", estimated "
          << estimate->wrench.head<3>().transpose();
    EXPECT_TRUE(estimate->contact) << "trial " << trial;
  }
  EXPECT_GT(tried, 50);
}

}  // namespace
}  // namespace live_stiffness
