#include "calibration/force_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibration.h"
#include "support/scenes.h"
#include "support/simulated_recording.h"

namespace live_stiffness {
namespace {

ForceSensorMount mountOf(double azimuth_deg, double height, const Eigen::Vector2d& crosstalk, double delay) {
  ForceSensorMount mount;
  mount.azimuth = radians(azimuth_deg);
  mount.height = height;
  mount.crosstalk = crosstalk;
  mount.delay = delay;
  return mount;
}

std::vector<SceneParameter> allOf(const ForceSensorMount& mount) {
  std::vector<SceneParameter> parameters;
  for (const std::string& name : forceSensorParameterNames()) parameters.push_back(*forceSensorParameter(name, mount));
  return parameters;
}

// What the sensor would read at `time` were it not late: pushes of two seconds, every other two, in turning directions,
// none too small to count as contact.
Wrench push(double time) {
  const double swing = std::sin(0.5 * kPi * time), size = swing > 1e-9 ? 0.1 + 0.1 * swing : 0.0;
  Wrench wrench;
  wrench << size * std::cos(time), size * std::sin(time), 0.5 * size, 1e-3 * size, -2e-3 * size, 5e-4 * size;
  return wrench;
}

// The arm under these pushes, its sensor mounted so: what `mount` makes of the recorded readings is what acted.
Recording pushedArm(const ForceSensorMount& mount) {
  SimulatedRecording simulated;
  simulated.position_noise = simulated.rotation_noise = 0.0;
  Recording pushed = simulated.record(arm());
  const StiffnessModel model(arm(), [] { ModelOptions o; o.stepping = Stepping::kContinuous; return o; }());
  StiffnessWorkspace workspace = model.makeWorkspace();
  const std::vector<Pressures> channels = gaugePressures(pushed);
  for (size_t i = 0; i < pushed.samples.size(); ++i) {
    RecordedSample& sample = pushed.samples[i];
    Pose X_BT = model.solve(kPairs.expand(channels[i]), Wrench::Zero(), workspace).X_BT;
    for (int k = 0; k < 30; ++k)  // the sensor turns with the tip
      X_BT = model.solve(kPairs.expand(channels[i]), mount.atTip(push(sample.time), X_BT.R), workspace).X_BT;
    const Pose X_AS = simulated.registration().sensorPose(X_BT);
    sample.tip_position = X_AS.p;
    sample.tip_orientation = Eigen::Quaterniond(X_AS.R);
    sample.tip_wrench = push(sample.time - mount.delay);
  }
  return pushed;
}

CalibrationOptions optionsWith(const ForceSensorMount& mount) {
  CalibrationOptions options;
  options.model.stepping = Stepping::kContinuous;
  options.correlation_time = 0.0;
  options.blocks = 0;
  options.force_sensor = mount;
  return options;
}

TEST(ForceSensorMount, CarriesTheWrenchToTheTipInBaseAxes) {
  const ForceSensorMount mount{radians(90.0), 0.01, -1.0};
  Wrench reading;
  reading << 1.0, 0.0, 0.0, 0.0, 0.0, 0.5;
  Wrench expected;
  expected << 0.0, -1.0, 0.0, 0.01, 0.0, -0.5;  // turned onto y and reversed; 10 mm above T: z x -y = +x
  EXPECT_LT((mount.atTip(reading, Matrix3::Identity()) - expected).norm(), 1e-15);
  const Matrix3 R_BT = expSo3(Vector3(0.3, -0.5, 0.2));
  const Wrench turned = mount.atTip(reading, R_BT);
  EXPECT_LT((linear(turned) - R_BT * linear(expected)).norm(), 1e-15);
  EXPECT_LT((angular(turned) - R_BT * angular(expected)).norm(), 1e-15);
}

TEST(ForceSensorMount, ChannelOfNoGainIsLeftOutInTheSensorsOwnAxes) {
  ForceSensorMount mount{radians(90.0)};
  mount.gains << 1.0, 1.0, 0.0, 0.0, 0.0, 0.0;
  Wrench expected;
  expected << -1.0, 1.0, 0.0, 0.0, 0.0, 0.0;
  EXPECT_LT((mount.atTip(Wrench::Ones(), Matrix3::Identity()) - expected).norm(), 1e-15);
  mount.gains << 1.0, 0.0, 0.0, 0.0, 0.0, 0.0;  // its x is the tip's y
  EXPECT_LT((mount.seen(Matrix3::Identity()) * Vector3(1.0, 2.0, 3.0) - Vector3(0.0, 2.0, 0.0)).norm(), 1e-15);
}

TEST(ForceSensorMount, CrosstalkIsTakenOffTheLateralChannelsEvenIfTheAxialOneDoesNotCount) {
  ForceSensorMount mount = mountOf(0.0, 0.0, {0.1, -0.2}, 0.0);
  mount.gains << 1.0, 1.0, 0.0, 0.0, 0.0, 0.0;
  Wrench reading = Wrench::Zero(), expected = Wrench::Zero();
  linear(reading) << 0.3, 0.1, -2.0;
  linear(expected) << 0.5, -0.3, 0.0;
  EXPECT_LT((mount.atTip(reading, Matrix3::Identity()) - expected).norm(), 1e-15);
}

TEST(ForceReadings, AreReadLaterByTheDelayAndBetweenReadings) {
  const Recording recording = pushedArm({});
  const ForceReadings readings(recording);
  for (double delay : {0.0, 0.1, -0.1})  // whole sample times
    EXPECT_LT((readings.atTip(mountOf(0.0, 0.0, {0.0, 0.0}, delay), 5.0, Matrix3::Identity()) - push(5.0 + delay)).norm(),
              1e-12);
  const Wrench between = 0.5 * (push(5.0) + push(5.1));
  EXPECT_LT((readings.atTip(mountOf(0.0, 0.0, {0.0, 0.0}, 0.05), 5.0, Matrix3::Identity()) - between).norm(), 1e-12);
}

TEST(Calibration, UsesTheForceSensorOfSamplesUnderContact) {
  const ForceSensorMount mount{radians(90.0), 0.005, -1.0};
  const CalibrationRecording data(pushedArm(mount), SampleChoice::kAll, LoadedSamples::kFit);
  const CalibrationResult with = calibrate(arm(), kPairs, {}, {data}, {}, optionsWith(mount));
  EXPECT_LT(with.recordings[0].used.max, 1e-5);  // exact but for the wrench's last turn
  ForceSensorMount other = mount;
  other.sign = 1.0;
  EXPECT_GT(calibrate(arm(), kPairs, {}, {data}, {}, optionsWith(other)).recordings[0].used.mean, 1e-3);
}

TEST(Calibration, FindsHowTheForceSensorIsMounted) {
  const ForceSensorMount truth = mountOf(7.0, -0.012, {0.08, -0.04}, 0.1);
  const CalibrationRecording data(pushedArm(truth), SampleChoice::kAll, LoadedSamples::kFit);
  std::vector<SceneParameter> parameters = allOf({});
  CalibrationOptions options = optionsWith({});
  options.use_priors = false;
  const CalibrationResult before = calibrate(arm(), kPairs, {}, {data}, {}, options);
  const CalibrationResult result = calibrate(arm(), kPairs, parameters, {data}, {}, options);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(degrees(result.force_sensor.azimuth), 7.0, 0.05);
  EXPECT_NEAR(result.force_sensor.height, -0.012, 1e-4);
  EXPECT_NEAR(result.force_sensor.crosstalk[0], 0.08, 1e-3);
  EXPECT_NEAR(result.force_sensor.crosstalk[1], -0.04, 1e-3);
  EXPECT_NEAR(result.force_sensor.delay, 0.1, 1e-3);
  // What is left are the samples at the begin of each push that the late sensor takes for free.
  EXPECT_LT(result.recordings[0].used.mean, 0.2 * before.recordings[0].used.mean);
}

}  // namespace
}  // namespace live_stiffness
