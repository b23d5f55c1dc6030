#include "live_stiffness/estimation/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "live_stiffness/checks.h"
#include "programs/recording_help.h"

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
  const Recording recording = parseRecording(kHeader + "1,1e5" + kPose + bad_line, "test");
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
  expectSkipped("2,1e5,1,2,3,1,0,0\n", {"line 3", "8 fields", "9"});
  expectSkipped("2,1e5,1,2,3,1,0,0,0,5\n", {"line 3", "10 fields"});
  expectSkipped("0.5,1e5" + kPose, {"line 3", "time goes back by 0.5 s", "sort"});
  expectSkipped("1,1e5" + kPose, {"line 3", "time is that of line 2"});
  expectSkipped("2,1e5,1,2,3,0,0,0,0\n", {"line 3", "quaternion"});
  expectSkipped("1,100,1,2,3,0,1e200,0,0\n", {"line 3", "quaternion"});
  expectSkipped("2,1e5,1,2,3,0.8,0.7,0,0\n", {"line 3", "quaternion has length 1.06", "must be 1"});
  expectSkipped("2,1e5,-3.697314E28,-3.697314E28,-3.697314E28,1,0,0,0\n", {"line 3", "position is 6.4", "within 1000 m"});
  expectSkipped("2,1e5,200,0,0,1,0,0,0\n", {"line 3", "position is 200 m away: must be within 5 m", "tip_x_mm"});
  expectSkipped("2,-3" + kPose, {"line 3", "channel 1 is -3", "must not be negative", "pressure_1_pa, without _abs"});
  expectSkipped("2,1e9" + kPose, {"line 3", "channel 1", "within 1e+08 Pa"});
}

// A tracker that loses its sensor writes one of these for as long as that lasts.
TEST(Recording, EachKindOfReasonIsSaidOnce) {
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {"NaN,NaN,NaN,NaN,NaN,NaN,NaN", "tip_x_m = 'NaN': must be a finite number"},
      {",,,,,,", "tip_x_m = '': must be a finite number"},
      {"#N/A,#N/A,#N/A,#N/A,#N/A,#N/A,#N/A", "tip_x_m = '#N/A': must be a finite number"},
      {"0,0,0,0,0,0,0", "quaternion is zero: the tracker does not see its sensor"}};
  for (const auto& [lost, reason] : kinds) {
    std::string csv = kHeader;
    for (int i = 0; i < 40; ++i)
      csv += std::to_string(0.1 * i) + ",1e5," + (i < 10 || i > 30 ? "1,2,3,1,0,0,0" : lost) + "\n";
    csv += "3.5,1e5" + kPose + "3.6,1e5" + kPose;
    const Recording recording = parseRecording(csv, "test");
    EXPECT_EQ(recording.samples.size(), 19u);
    ASSERT_EQ(recording.warnings.size(), 2u) << recording.warnings[2];
    EXPECT_EQ(recording.warnings[0], "21 lines left out, first line 12: " + reason);
    EXPECT_EQ(recording.warnings[1].find("2 lines left out, first line 42: time goes back by 0.4 s"), 0u);
  }
}

TEST(Recording, IsTheSameFromSpreadsheets) {
  const std::string header = "time_s;pressure_1_pa;tip_x_m;tip_y_m;tip_z_m;tip_qw;tip_qx;tip_qy;tip_qz";
  const Recording recording = parseRecording(
      "\xEF\xBB\xBFsep=;\r\n% Aurora\r\n" + header + ";\r\ns;Pa;m;m;m;;;;\r\n"
      "0,5;2e4;0,1;\"0,2\";0,3;1;0;0;0;\r\n", "test");
  ASSERT_EQ(recording.samples.size(), 1u);
  EXPECT_EQ(recording.samples[0].time, 0.5);
  EXPECT_EQ(recording.samples[0].line, 5);
  EXPECT_EQ(recording.samples[0].pressures[0], 2e4);
  EXPECT_EQ(recording.samples[0].tip_position, Vector3(0.1, 0.2, 0.3));
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_NE(recording.warnings[0].find("row of units"), std::string::npos);
  const std::vector<std::string> faults = faultsIn(header + "\ns;kPa;mm;m;m;;;;\n0;20;1;0;0;1;0;0;0\n");
  ASSERT_EQ(faults.size(), 3u);  // and what the columns are
  EXPECT_NE(faults[0].find("pressure_1_pa has 'kPa'"), std::string::npos) << faults[0];
  EXPECT_NE(faults[1].find("tip_x_m has 'mm'"), std::string::npos) << faults[1];
}

TEST(Recording, UnitsAreThoseInTheNames) {
  const std::vector<std::pair<std::string, double>> units = {
      {"pa", 1.0}, {"kpa", 1e3}, {"bar", 1e5}, {"mbar", 1e2}, {"psi", 6894.757293168361}};
  for (const auto& [unit, pascals] : units)
    for (const std::string reference : {"", "_abs"}) {
      const Recording recording = parseRecording("time_ms,pressure_1_" + unit + reference +
          ",tip_x_mm,tip_y_mm,tip_z_mm,tip_qw,tip_qx,tip_qy,tip_qz\n20,14.5,100,200,300,1,0,0,0\n", "test");
      EXPECT_EQ(recording.absolute, !reference.empty());
      EXPECT_EQ(recording.samples.at(0).time, 0.02);
      EXPECT_NEAR(recording.samples[0].pressures[0], 14.5 * pascals, 1e-9);
      EXPECT_LT((recording.samples[0].tip_position - Vector3(0.1, 0.2, 0.3)).norm(), 1e-15);
    }
  EXPECT_EQ(faultsIn("time_s,pressure_1_pa,pressure_2_kpa" + kTip + "\n").size(), 3u);  // no pressure_1_kpa; two units
}

TEST(Recording, WithoutQuaternionsIsOfPositions) {
  const Recording recording = parseRecording("time_s,pressure_1_pa,tip_x_m,tip_y_m,tip_z_m\n0,2e4,1,2,3\n", "test");
  EXPECT_EQ(recording.measures, TrackerMeasures::kPosition);
  EXPECT_EQ(recording.samples.at(0).tip_orientation.coeffs(), Eigen::Quaterniond::Identity().coeffs());
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_NE(recording.warnings[0].find("positions only"), std::string::npos);
  EXPECT_FALSE(parseRecording(kHeader + "1,1e5" + kPose, "test").measures);
  EXPECT_EQ(faultsIn("time_s,pressure_1_pa,tip_x_m,tip_y_m,tip_z_m,tip_qw\n").size(), 4u);  // three of the quaternion
}

TEST(Recording, SaysForHowLongAPoseIsRepeated) {
  const std::string turned = ",1,2,3,0,1,0,0\n", moved = ",1,2.1,3,0,1,0,0\n", negative = ",1,2.1,3,0,-1,0,0\n";
  const Recording recording = parseRecording(kHeader + "0,9" + kPose + "0.5,9" + kPose + "0.75,9" + kPose + "1,9" + turned +
                                                 "1.5,9" + moved + "2,9" + negative, "test");
  std::vector<double> unchanged;
  for (const RecordedSample& sample : recording.samples) unchanged.push_back(sample.unchanged_for);
  EXPECT_EQ(unchanged, std::vector<double>({0.0, 0.5, 0.75, 0.0, 0.0, 0.5}));
}

TEST(Recording, ABaseNearTheTipMakesADistantTrackerPlausible) {
  const std::string header = "time_s,pressure_1_pa,base_x_m,base_y_m,base_z_m,base_qw,base_qx,base_qy,base_qz" + kTip + "\n";
  const Recording recording = parseRecording(header + "0,2e4,8,0,0,0,0,0,-1.01,8,0,0.1,1,0,0,0\n" +
                                                 "1,2e4,8,0,0,0,0,0,0,8,0,0.1,1,0,0,0\n", "test");
  ASSERT_EQ(recording.samples.size(), 1u);
  ASSERT_TRUE(recording.samples[0].base_orientation);
  EXPECT_NEAR(recording.samples[0].base_orientation->z(), -1.0, 1e-15);
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_NE(recording.warnings[0].find("line 3: base sensor: quaternion is zero"), std::string::npos);
}

// Warnings about all of a recording with two samples, `interval` apart.
std::vector<std::string> doubts(const std::string& pressures, const std::string& first, const std::string& last,
                                double interval = 0.6, std::optional<double> largest_pressure = std::nullopt) {
  const auto line = [&](double time, const std::string& values) {
    return std::to_string(time) + "," + values + ",0,0,0,1,0,0,0\n";
  };
  return parseRecording("time_s," + pressures + kTip + "\n" + line(0, first) + line(interval, last), "test",
                        largest_pressure).warnings;
}

TEST(Recording, WarnsOfUnitsAndReferencesThatNoRobotHas) {
  const auto warns = [](const std::vector<std::string>& warnings, const std::string& text) {
    return warnings.size() == 1 && warnings[0].find(text) != std::string::npos;
  };
  const std::string gauge = "pressure_1_pa,pressure_2_pa", absolute = "pressure_1_pa_abs,pressure_2_pa_abs";
  EXPECT_TRUE(doubts(gauge, "0,0", "2e4,0").empty());
  EXPECT_TRUE(doubts(absolute, "101e3,99e3", "120e3,99e3").empty());
  EXPECT_TRUE(warns(doubts(gauge, "0,0", "60,0"), "no pressure is above 60 Pa: another unit? (name the columns pressure_1_kpa"));
  EXPECT_TRUE(doubts(gauge, "0,0", "1500,0").empty());
  EXPECT_TRUE(warns(doubts(gauge, "0,0", "1500,0", 0.6, 2e6), "no pressure is above 1500 Pa"));
  EXPECT_TRUE(warns(doubts(gauge, "101e3,102e3", "120e3,99e3"),
                    "at rest 101.5 kPa in all channels: told gauge, sent absolute? (name the columns pressure_1_pa_abs)"));
  EXPECT_TRUE(warns(doubts(gauge, "150e3,150e3", "101e3,99e3"), "at rest 100 kPa")) << "it is at rest at the end";
  EXPECT_TRUE(warns(doubts(gauge, "-101e3,-101e3", "0,-101e3"), "told absolute, sent gauge? (name the columns pressure_1_pa,"));
  EXPECT_TRUE(warns(doubts(absolute, "0,100", "5e4,100"), "told absolute, sent gauge?"));
  EXPECT_TRUE(doubts(gauge, "101e3,0", "120e3,0").empty()) << "one channel only";
  EXPECT_TRUE(warns(doubts(gauge, "0,0", "2e4,0", 25.0), "samples are 25 s apart: time in milliseconds? (name the column"));
}

// Each word of --help that is a column is read as one.
TEST(Recording, HasTheColumnsThatHelpNames) {
  std::istringstream words(kRecordingHelp);
  std::string names, values, word;
  const char* const parts[] = {"time_", "pressure_", "tip_", "base_", "force_", "torque_"};
  int count = 0;
  while (words >> word) {
    word.erase(std::remove(word.begin(), word.end(), ','), word.end());
    const auto begins = [&](const char* part) { return word.find(part) == 0; };
    const bool is_column = std::any_of(std::begin(parts), std::end(parts), begins);
    if (!is_column || word == "time_ms" || word == "pressure_1_pa_abs") continue;  // one of two
    names += (count == 0 ? "" : ",") + word;
    values += count++ == 0 ? "0" : word.find("_qw") != std::string::npos ? ",1" : word.find("pressure") == 0 ? ",2e4" : ",0";
  }
  EXPECT_EQ(count, 1 + 2 + 7 + 7 + 6);
  const Recording recording = parseRecording(names + "\n" + values + "\n", "test");
  EXPECT_TRUE(recording.warnings.empty()) << recording.warnings.front();
  EXPECT_TRUE(recording.samples.at(0).base_orientation && recording.samples[0].tip_wrench);
}

TEST(Recording, OfAnotherFormatIsRefusedAsThat) {
  EXPECT_EQ(faultsIn("#ROSBAG V2.0\n"), std::vector<std::string>({"is a bag: must be CSV"}));
  EXPECT_EQ(faultsIn("PK\x03\x04").size(), 1u);
}

TEST(Recording, BlankLinesAndCarriageReturnsAndByteOrderMarkAreHarmless) {
  const Recording recording =
      parseRecording("\xEF\xBB\xBFtime_s, pressure_1_pa" + kTip + "\r\n\r\n0, 2e4 ,1,2,3,1,0,0,0\r\n", "test");
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
  // The last of each says which columns there are.
  EXPECT_EQ(faultsIn("").size(), 6u);  // time, pressures, three positions
  EXPECT_EQ(faultsIn("time_s,time_s,pressure_1_pa,pressure_3_pa" + kTip + "\n").size(), 3u);  // repeated; channel 2
  EXPECT_EQ(faultsIn("time_s,pressure_1_pa,pressure_1_pa_abs" + kTip + "\n").size(), 2u);     // gauge and absolute
  EXPECT_EQ(faultsIn("time_s,pressure_1_pa,base_x_m" + kTip + "\n").size(), 3u);              // base y and z
  EXPECT_EQ(faultsIn("time_s,pressure_1_pa,force_x_n,force_y_n,force_z_n" + kTip + "\n").size(), 4u);  // no torque
}

TEST(Recording, UnknownColumnsAreIgnoredWithAWarning) {
  const Recording recording = parseRecording("time_s,pressure_1_pa,room_c" + kTip + "\n0,2e4,21,1,2,3,1,0,0,0\n", "test");
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
