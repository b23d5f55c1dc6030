#include "bags/recorded_bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "live_stiffness/checks.h"
#include "ros/conversions.h"
#include "support/matrix_near.h"

namespace live_stiffness {
namespace {

// A bag of its own for each test, taken away again.
class RecordedBag : public ::testing::Test {
 protected:
  RecordedBag()
      : path_(std::string(::testing::TempDir()) + "recorded_" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".bag"),
        bag_(path_, rosbag::bagmode::Write) {}
  ~RecordedBag() override { std::remove(path_.c_str()); }

  void pressures(double time, double pressure) {
    const ros::Time stamp(time);
    bag_.write("/chamber_pressures", stamp, toPressures(Pressures::Constant(3, pressure), stamp));
  }
  void pose(double time, double x) {
    const ros::Time stamp(time);
    bag_.write("aurora_pose", stamp, toPoseStamped({Matrix3::Identity(), Vector3(x, 0.0, 0.0)}, stamp, "aurora"));
  }
  void wrench(double time, double force, const std::string& frame) {
    const ros::Time stamp(time);
    bag_.write("tip_force_torque", stamp, toWrenchStamped(Wrench(force * Wrench::Unit(0)), stamp, frame));
  }
  // At 10.5, 11.5 and 12.5 s, 0.1 m apart, each with pressures before it; the bag is closed.
  void threePoses() {
    for (int i = 0; i < 3; ++i) {
      pressures(10.0 + i, 1e4);
      pose(10.5 + i, 0.1 * i);
    }
    bag_.close();
  }
  Recording load() {
    bag_.close();
    return loadRecordedBags({path_}, {}, {});
  }
  static std::string refusalOf(const std::string& path) {
    try {
      loadRecordedBags({path}, {}, {});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it was read";
  }

  std::string path_;
  rosbag::Bag bag_;
};

TEST_F(RecordedBag, GivesEachPoseTheNewestPressuresAndWrenchBeforeIt) {
  pressures(10.0, 1e4);
  wrench(10.1, 0.5, "any_sensor_frame");
  pose(10.2, 0.1);
  pressures(10.3, 2e4);
  wrench(10.3, 0.7, "any_sensor_frame");
  pose(10.4, 0.2);
  const Recording recording = load();
  ASSERT_EQ(recording.samples.size(), 2u);
  EXPECT_TRUE(recording.warnings.empty());
  for (int i : {0, 1}) {
    const RecordedSample& sample = recording.samples[i];
    EXPECT_NEAR(sample.time, 0.2 * i, 1e-6);
    EXPECT_TRUE(matrixNear(sample.pressures, Pressures::Constant(3, 1e4 * (i + 1)), 0.0));
    EXPECT_TRUE(matrixNear(sample.tip_position, Vector3(0.1 * (i + 1), 0.0, 0.0), 0.0));
    ASSERT_TRUE(sample.tip_wrench.has_value());
    EXPECT_EQ((*sample.tip_wrench)[0], i == 0 ? 0.5 : 0.7);
  }
}

// Topics, units and an absolute pressure of a rig's own.
TEST_F(RecordedBag, ReadsWhatARigOfItsOwnHasRecorded) {
  const ros::Time stamp(10.0);
  bag_.write("/valves/pressure", stamp, toPressures(Pressures::Constant(3, 111.325), stamp));
  bag_.write("ndi/tool_1", stamp, toPoseStamped({Matrix3::Identity(), Vector3(120.0, 0.0, 0.0)}, stamp, "aurora"));
  bag_.write("/nano17", stamp, toWrenchStamped(Wrench(0.5 * Wrench::Unit(0)), stamp, "nano17"));
  bag_.close();
  InputParameters parameters;
  parameters.pressure_format = {"kPa", "absolute"};
  parameters.position_unit = "mm";
  const Recording recording = loadRecordedBags({path_}, {"valves/pressure", "/ndi/tool_1", "nano17"}, parameters);
  ASSERT_EQ(recording.samples.size(), 1u);
  EXPECT_TRUE(matrixNear(recording.samples[0].pressures, Pressures::Constant(3, 10e3), 1e-6));
  EXPECT_TRUE(matrixNear(recording.samples[0].tip_position, Vector3(0.12, 0.0, 0.0), 1e-12));
  ASSERT_TRUE(recording.samples[0].tip_wrench.has_value());
  EXPECT_THROW(loadRecordedBags({path_}, {}, {}), ConfigurationError) << "nothing is on the topics of the node";
}

TEST_F(RecordedBag, WarnsOfUnitsThatNoRobotHas) {
  pressures(10.0, 50.0);  // kPa
  pose(10.1, 20.0);       // mm
  pose(10.2, 50.0);
  bag_.close();
  EXPECT_NE(refusalOf(path_).find("position is 20 m away"), std::string::npos) << refusalOf(path_);
  InputParameters parameters;
  parameters.position_unit = "mm";
  const Recording recording = loadRecordedBags({path_}, {}, parameters);
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_NE(recording.warnings[0].find("above 50 Pa"), std::string::npos) << recording.warnings[0];
}

TEST_F(RecordedBag, LeavesOutWhatCannotBeReadAndSaysSo) {
  pose(9.0, 0.0);  // before any pressures
  pressures(10.0, 1e4);
  pose(10.1, std::nan(""));
  wrench(10.1, std::nan(""), "");
  pose(10.2, 0.1);
  const Recording recording = load();
  ASSERT_EQ(recording.samples.size(), 1u);
  EXPECT_FALSE(recording.samples[0].tip_wrench.has_value());
  ASSERT_EQ(recording.warnings.size(), 3u);
  EXPECT_NE(recording.warnings[0].find("aurora_pose: 1 cannot be used"), std::string::npos) << recording.warnings[0];
  EXPECT_NE(recording.warnings[1].find("tip_force_torque: 1 cannot be used"), std::string::npos) << recording.warnings[1];
  EXPECT_NE(recording.warnings[2].find("1 poses left out"), std::string::npos) << recording.warnings[2];
}

// What it was recorded with has been killed, or its disk was full.
TEST_F(RecordedBag, CutOffIsRefusedInOneLineWithTheReasonAndTheWayOut) {
  threePoses();
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  const std::string refusal = refusalOf(path_);
  EXPECT_EQ(refusal.find("bag " + path_ + ": cannot be read: "), 0u) << refusal;
  EXPECT_NE(refusal.find("`rosbag reindex " + path_ + "`"), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
}

TEST_F(RecordedBag, ThatWasNeverClosedIsRefusedAsUnindexed) {
  pressures(10.0, 1e4);
  pose(10.5, 0.0);  // the bag is still open, and what is on the disk has no index
  EXPECT_NE(refusalOf(path_).find("cannot be read: Bag unindexed"), std::string::npos) << refusalOf(path_);
}

TEST_F(RecordedBag, OfMessagesThatEndTooEarlyIsRefused) {
  const ros::Time stamp(10.0);
  pressures(10.0, 1e4);
  wrench(10.1, 0.5, "any_sensor_frame");
  bag_.close();
  const std::string frame = "any_sensor_frame";
  std::fstream file(path_, std::ios::binary | std::ios::in | std::ios::out);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  const size_t found = whole.find(frame);
  ASSERT_NE(found, std::string::npos);
  file.clear();
  file.seekp(static_cast<std::streamoff>(found - 1));  // the last byte of its length
  file << '\x01';
  file.close();
  EXPECT_NE(refusalOf(path_).find("cannot be read: "), std::string::npos) << refusalOf(path_);
}

TEST_F(RecordedBag, WithoutASampleIsAConfigurationError) {
  pressures(10.0, 1e4);
  EXPECT_THROW(load(), ConfigurationError);
  EXPECT_NE(refusalOf(path_ + ".missing").find(path_ + ".missing: cannot be read: "), std::string::npos);
}

}  // namespace
}  // namespace live_stiffness
