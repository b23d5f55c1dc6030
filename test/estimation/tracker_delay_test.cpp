#include "estimation/tracker_delay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "estimation/interpolation.h"

namespace live_stiffness {
namespace {

// A tip that swings: 20 mm at 0.3 Hz along x, 10 mm at 0.5 Hz along y.
Vector3 swing(double time) { return {0.02 * std::sin(1.9 * time), 0.01 * std::sin(3.1 * time), 0.1}; }

const Wrench kPush = Wrench::Ones();  // a sample with it is touched, and does not count

struct Swinging {
  Recording recording;
  std::vector<Vector3> predicted;

  Swinging(double delay, double noise) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 600; ++k) {
      const double time = 0.05 * k;
      const double x = normal(random), y = normal(random), z = normal(random);
      predicted.push_back(swing(time));
      RecordedSample& sample = recording.samples.emplace_back();
      sample.time = time;
      sample.tip_position = swing(time - delay) + noise * Vector3(x, y, z);
      if (time <= 1.0 || time >= 29.0) sample.tip_wrench = kPush;  // beyond the ends nothing is known
    }
  }
  TrackerDelay fit() const { return fitTrackerDelay(recording, predicted); }
};

TEST(TrackerDelay, IsFoundWhetherThePosesAreLateOrEarly) {
  for (double delay : {-0.21, -0.03, 0.0, 0.004, 0.15, 0.37}) {
    const TrackerDelay found = Swinging(delay, 0.0).fit();
    EXPECT_TRUE(found.determined);
    // Chords of a sine of 3.1 rad/s over 50 ms are short by 3e-3 of the amplitude, which moves no zero of its slope.
    EXPECT_NEAR(found.delay, delay, 2e-4);
    EXPECT_LT(found.rms, 4e-5);  // those chords: 30 and 23 um at the turns along y and x
  }
}

TEST(TrackerDelay, ErrorUnderNoiseIsWithinItsStandardError) {
  const TrackerDelay found = Swinging(0.15, 0.5e-3).fit();
  EXPECT_NEAR(found.delay, 0.15, 3.0 * found.standard_error);
  EXPECT_LT(found.standard_error, 0.02);
  EXPECT_NEAR(found.rms, std::sqrt(3.0) * 0.5e-3, 0.05e-3);  // 560 samples: 3 % of it
  EXPECT_GT(found.rms_before, 2e-3);
}

TEST(TrackerDelay, IsNotDeterminedAtRestAndThenZero) {
  Swinging still(0.15, 0.5e-3);
  std::fill(still.predicted.begin(), still.predicted.end(), Vector3(0.0, 0.0, 0.1));
  const TrackerDelay found = still.fit();
  EXPECT_FALSE(found.determined);
  EXPECT_EQ(found.delay, 0.0);
  EXPECT_NE(found.text().find("NOT determined"), std::string::npos);
}

TEST(TrackerDelay, DisregardsSamplesThatAreTouched) {
  Swinging pushed(0.15, 0.0);
  for (size_t i = 100; i < 200; ++i) {
    pushed.recording.samples[i].tip_position += Vector3(0.05, 0.0, 0.0);
    pushed.recording.samples[i].tip_wrench = kPush;
  }
  EXPECT_NEAR(pushed.fit().delay, 0.15, 2e-4);
}

TEST(WithTrackerDelay, PairsEachPoseWithThePressuresAndTheWrenchOfTheDelayBefore) {
  Recording recording;
  for (int k = 0; k < 10; ++k) {
    RecordedSample sample;
    sample.time = 0.1 * k;
    sample.pressures = Pressures::Constant(3, 1000.0 * k);
    sample.tip_position = Vector3(k, 0.0, 0.0);
    sample.tip_wrench = Wrench::Constant(k);
    recording.samples.push_back(sample);
  }
  const Recording shifted = withTrackerDelay(recording, 0.25);
  EXPECT_NEAR(shifted.samples[6].pressures[1], 3500.0, 1e-9);
  EXPECT_NEAR((*shifted.samples[6].tip_wrench)[2], 3.5, 1e-12);
  EXPECT_EQ(shifted.samples[6].tip_position.x(), 6.0);
  EXPECT_EQ(shifted.samples[1].pressures[0], 0.0) << "before the first sample: as the first";
  EXPECT_NEAR(withTrackerDelay(recording, -0.25).samples[2].pressures[1], 4500.0, 1e-9);
}

TEST(Interpolated, IsBetweenTheTwoNeighboursAndAtTheEndsOutside) {
  const std::vector<double> times = {1.0, 2.0, 4.0}, values = {10.0, 20.0, 40.0};
  for (const auto& [time, value] : {std::pair(0.0, 10.0), std::pair(1.0, 10.0), std::pair(1.5, 15.0),
                                    std::pair(2.0, 20.0), std::pair(3.5, 35.0), std::pair(4.0, 40.0), std::pair(9.0, 40.0)})
    EXPECT_NEAR(interpolated(times, values, time), value, 1e-12) << time;
  EXPECT_EQ(interpolated({3.0}, std::vector<double>{7.0}, 5.0), 7.0);
}

}  // namespace
}  // namespace live_stiffness
