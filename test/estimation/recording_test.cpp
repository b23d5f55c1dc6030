#include "live_stiffness/estimation/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

const std::string kTip = ",tip_x_m,tip_y_m,tip_z_m,tip_qw,tip_qx,tip_qy,tip_qz";
const std::string kHeader = "time_s,pressure_1_pa_abs" + kTip + "\n";
const std::string kPose = ",1,2,3,1,0,0,0\n";  // closes a line

std::vector<std::string> faultsIn(const std::string& csv) {
  try {
    parseRecording(csv, "test");
  } catch (const ConfigurationError& error) {
    return error.faults();
  }
  return {};
}

// One warning that holds all of the words, and one sample left.
void expectSkipped(const std::string& bad_line, const std::vector<std::string>& words) {
  SCOPED_TRACE(bad_line);
  const Recording recording = parseRecording(kHeader + "1,100" + kPose + bad_line, "test");
  EXPECT_EQ(recording.samples.size(), 1u);
  ASSERT_EQ(recording.warnings.size(), 1u);
  for (const std::string& word : words) EXPECT_NE(recording.warnings[0].find(word), std::string::npos) << word;
}

// A recording of one channel: pressure by time, every 0.05 s from 0 to `end`.
template <class PressureAt>
Recording sampled(double end, PressureAt pressure_at) {
  std::ostringstream csv;
  csv << kHeader;
  for (int k = 0; 0.05 * k <= end + 1e-9; ++k) csv << 0.05 * k << "," << pressure_at(0.05 * k) << kPose;
  return parseRecording(csv.str(), "test");
}

TEST(Recording, FindsColumnsByNameInAnyOrder) {
  const Recording recording = parseRecording(
      "tip_qz,tip_qy,tip_qx,tip_qw,tip_z_m,tip_y_m,tip_x_m,pressure_2_pa,pressure_1_pa,time_s\n"
      "0,0,0.6,0.8,3,2,1,20,10,7\n", "test");
  ASSERT_EQ(recording.samples.size(), 1u);
  const RecordedSample& sample = recording.samples[0];
  EXPECT_EQ(sample.time, 7.0);
  EXPECT_EQ(sample.line, 2);
  EXPECT_EQ(sample.pressures, Eigen::Vector2d(10.0, 20.0));
  EXPECT_EQ(sample.tip_position, Vector3(1.0, 2.0, 3.0));
  EXPECT_NEAR(sample.tip_orientation.x(), 0.6, 1e-15);
  EXPECT_FALSE(recording.absolute);
  EXPECT_FALSE(sample.base_position || sample.tip_wrench);
}

TEST(Recording, ReadsBaseAndForceWhenThere) {
  const Recording recording = parseRecording(
      "time_s,pressure_1_pa_abs,base_x_m,base_y_m,base_z_m" + kTip +
      ",force_x_n,force_y_n,force_z_n,torque_x_nm,torque_y_nm,torque_z_nm\n0,1,4,5,6,1,2,3,1,0,0,0,.1,.2,.3,.4,.5,.6\n",
      "test");
  const RecordedSample& sample = recording.samples.at(0);
  ASSERT_TRUE(sample.base_position && sample.tip_wrench);
  EXPECT_EQ(*sample.base_position, Vector3(4.0, 5.0, 6.0));
  EXPECT_EQ(linear(*sample.tip_wrench), Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(angular(*sample.tip_wrench), Vector3(0.4, 0.5, 0.6));
}

TEST(Recording, BadLinesAreSkippedWithTheirNumber) {
  expectSkipped("2,nan" + kPose, {"line 3", "pressure_1_pa_abs", "nan"});
  expectSkipped("2,inf" + kPose, {"line 3", "inf"});
  expectSkipped("2,12x" + kPose, {"line 3", "12x"});
  expectSkipped("2," + kPose, {"line 3"});
  expectSkipped("2,100,1,2,3,1,0,0\n", {"line 3", "8 fields", "9"});
  expectSkipped("2,100,1,2,3,1,0,0,0,5\n", {"line 3", "10 fields"});
  expectSkipped("0.5,100" + kPose, {"line 3", "time 0.5", "line 2"});
  expectSkipped("1,100" + kPose, {"line 3", "time"});
  expectSkipped("2,100,1,2,3,0,0,0,0\n", {"line 3", "quaternion"});
  expectSkipped("1,100,1,2,3,0,1e200,0,0\n", {"line 3", "quaternion"});
}

TEST(Recording, BlankLinesAndCarriageReturnsAndByteOrderMarkAreHarmless) {
  const Recording recording =
      parseRecording("\xEF\xBB\xBFtime_s, pressure_1_pa" + kTip + "\r\n\r\n0, 5 ,1,2,3,1,0,0,0\r\n", "test");
  EXPECT_EQ(recording.samples.size(), 1u);
  EXPECT_TRUE(recording.warnings.empty());
}

TEST(Recording, NothingLeftIsAnErrorWithTheReasons) {
  const std::vector<std::string> faults = faultsIn(kHeader + "0,nan" + kPose);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_NE(faults[1].find("line 2"), std::string::npos);
  EXPECT_EQ(faultsIn(kHeader).size(), 1u);
  EXPECT_THROW(loadRecording("/nowhere/at_all.csv"), ConfigurationError);
}

TEST(Recording, HeaderFaultsComeAllAtOnce) {
  EXPECT_EQ(faultsIn("").size(), 9u);  // time, pressures, three positions, four of the quaternion
  EXPECT_EQ(faultsIn("time_s,time_s,pressure_1_pa,pressure_3_pa" + kTip + "\n").size(), 2u);  // repeated; channel 2
  EXPECT_EQ(faultsIn("time_s,pressure_1_pa,pressure_1_pa_abs" + kTip + "\n").size(), 1u);     // gauge and absolute
  EXPECT_EQ(faultsIn("time_s,pressure_1_pa,base_x_m" + kTip + "\n").size(), 2u);              // base y and z
  EXPECT_EQ(faultsIn("time_s,pressure_1_pa,force_x_n,force_y_n,force_z_n" + kTip + "\n").size(), 3u);  // no torque
}

TEST(Recording, UnknownColumnsAreIgnoredWithAWarning) {
  const Recording recording = parseRecording("time_s,pressure_1_pa,room_c" + kTip + "\n0,5,21,1,2,3,1,0,0,0\n", "test");
  EXPECT_EQ(recording.samples.size(), 1u);
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_NE(recording.warnings[0].find("room_c"), std::string::npos);
}

TEST(Recording, QuaternionsAreUnitAndContinuousInSign) {
  const Recording recording = parseRecording(
      kHeader + "0,1,0,0,0,0.01,-0.36,0.93,0\n1,1,0,0,0,-0.01,0.37,-0.92,0\n2,1,0,0,0,-0.02,0.36,-0.93,0\n", "test");
  ASSERT_EQ(recording.samples.size(), 3u);
  for (const RecordedSample& sample : recording.samples) {
    EXPECT_NEAR(sample.tip_orientation.norm(), 1.0, 1e-15);
    EXPECT_LT(sample.tip_orientation.x(), 0.0);  // the first one's sign
  }
}

TEST(GaugePressures, LeaveOutTheRestPerChannel) {
  // Rest of 100 and 102 over the first 0.5 s (inclusive); what follows must not count.
  const Recording recording = parseRecording(
      kHeader + "5.0,100" + kPose + "5.5,102" + kPose + "5.6,901" + kPose, "test");
  const std::vector<Pressures> gauge = gaugePressures(recording);
  ASSERT_EQ(gauge.size(), 3u);
  EXPECT_EQ(gauge[0][0], -1.0);
  EXPECT_EQ(gauge[2][0], 800.0);
  const Recording slow = parseRecording(kHeader + "5.0,100" + kPose + "5.6,901" + kPose, "test");
  EXPECT_EQ(gaugePressures(slow)[0][0], 0.0);  // at least the first sample
}

TEST(GaugePressures, OfAGaugeRecordingAreAsTheyAre) {
  const Recording recording = parseRecording("time_s,pressure_1_pa" + kTip + "\n0,500" + kPose, "test");
  EXPECT_EQ(gaugePressures(recording)[0][0], 500.0);
}

TEST(QuasiStatic, DropsFromBeforeAStepUntilAfterIt) {
  // Samples 2.00 and earlier at zero, 2.05 and later at 5 kPa. Pairs up to 0.25 s apart straddle the step from 1.80 to
  // 2.25 s, so 0.3 s ahead of 1.80 to 1.0 s past 2.25 is dropped.
  const Recording recording = sampled(6.0, [](double t) { return t < 2.025 ? 1e5 : 1.05e5; });
  std::vector<double> times;
  for (int k : quasiStaticSamples(recording)) times.push_back(recording.samples[k].time);
  ASSERT_FALSE(times.empty());
  for (double t : times) EXPECT_TRUE(t < 1.5 + 0.01 || t > 3.25 - 0.01) << t;
  EXPECT_EQ(times.size(), 30u + 55u);  // 0 to 1.45 and 3.30 to 6.00 s
}

TEST(QuasiStatic, KeepsSlowRampsAndSmallNoise) {
  // 4 kPa/s is 1 kPa in 0.25 s; noise of 0.9 kPa peak to peak on top stays below 2 kPa.
  const Recording recording =
      sampled(3.0, [](double t) { return 1e5 + 4000.0 * t + (std::lround(t / 0.05) % 2 ? 450.0 : -450.0); });
  EXPECT_EQ(quasiStaticSamples(recording).size(), recording.samples.size());
}

TEST(QuasiStatic, SeesMotionBetweenSamplesFartherApartThanItsWindow) {
  // 6 kPa/s with a sample every 0.5 s: none lies within 0.25 s of another.
  Recording recording = sampled(3.0, [](double t) { return 1e5 + 6000.0 * t; });
  std::vector<RecordedSample> few;
  for (size_t k = 0; k < recording.samples.size(); k += 10) few.push_back(recording.samples[k]);
  recording.samples = few;
  EXPECT_TRUE(quasiStaticSamples(recording).empty());
}

TEST(Unloaded, IsBelowTheForceOrWithoutSensor) {
  RecordedSample sample;
  EXPECT_TRUE(isUnloaded(sample));
  sample.tip_wrench = Wrench::Zero();
  linear(*sample.tip_wrench) = Vector3(0.0, 0.059, 0.0);
  EXPECT_TRUE(isUnloaded(sample));
  linear(*sample.tip_wrench) = Vector3(0.05, 0.05, 0.0);
  EXPECT_FALSE(isUnloaded(sample));
}

}  // namespace
}  // namespace live_stiffness
