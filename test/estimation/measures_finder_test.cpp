#include "estimation/measures_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "live_stiffness/conventions.h"

namespace live_stiffness {
namespace {

// A tip that sways by 30 deg and 20 mm, in 200 poses.
template <class Spoil>
std::optional<TrackerMeasures> foundOf(Spoil spoil) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> turn(-kPi, kPi);
  MeasuresFinder finder;
  for (int i = 0; i < 200; ++i) {
    const double sway = std::sin(0.05 * i);
    const Pose X{expSo3(Vector3(0.5 * sway, 0.2, 0.1)), Vector3(0.0, 0.02 * sway, 0.1)};
    finder.add(spoil(X, [&] { return turn(random); }));
  }
  return finder.found();
}

TEST(MeasuresFinder, DoesNotDoubtAWholePose) {
  EXPECT_FALSE(foundOf([](const Pose& X, auto) { return X; }));
  EXPECT_FALSE(foundOf([](const Pose& X, auto random) {  // five times the noise of an Aurora
    return Pose{X.R * expSo3(0.002 * Vector3(random(), random(), random())), X.p};
  }));
}

TEST(MeasuresFinder, FindsAnOrientationThatNeverChanges) {
  EXPECT_EQ(foundOf([](const Pose& X, auto) { return Pose{Matrix3::Identity(), X.p}; }), TrackerMeasures::kPosition);
}

TEST(MeasuresFinder, LeavesOpenWhatARobotAtRestDoesNotShow) {
  EXPECT_FALSE(foundOf([](const Pose&, auto random) {
    return Pose{Matrix3::Identity(), 1e-4 * Vector3(random(), random(), random())};
  }));
}

TEST(MeasuresFinder, FindsATurnAboutTheAxisThatIsNoise) {
  EXPECT_EQ(foundOf([](const Pose& X, auto random) { return Pose{X.R * expSo3(random() * Vector3::UnitZ()), X.p}; }),
            TrackerMeasures::kPositionAndAxis);
}

TEST(MeasuresFinder, FindsAnOrientationThatIsAllNoise) {
  EXPECT_EQ(foundOf([](const Pose& X, auto random) { return Pose{expSo3(Vector3(random(), random(), random())), X.p}; }),
            TrackerMeasures::kPosition);
}

// What is measured stays, what is not comes from the model.
TEST(CompletedPose, TakesTheSmallestRotationToTheMeasuredAxis) {
  const Pose expected{expSo3(Vector3(0.1, -0.2, 0.3)), Vector3::Zero()};
  const Pose seen{expSo3(Vector3(0.3, 0.1, 2.0)), Vector3(1.0, 2.0, 3.0)};
  const Pose completed = completedPose(seen, expected, TrackerMeasures::kPositionAndAxis);
  EXPECT_EQ(completed.p, seen.p);
  EXPECT_NEAR((completed.R.col(2) - seen.R.col(2)).norm(), 0.0, 1e-14);
  const Vector3 turn = logSo3(completed.R * expected.R.transpose());
  EXPECT_NEAR(turn.dot(seen.R.col(2)), 0.0, 1e-14);
  EXPECT_EQ(completedPose(seen, expected, TrackerMeasures::kPosition).R, expected.R);
  EXPECT_EQ(completedPose(seen, expected, TrackerMeasures::kPose).R, seen.R);
}

}  // namespace
}  // namespace live_stiffness
