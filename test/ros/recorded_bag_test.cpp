#include "ros/recorded_bag.h"

#include <console_bridge/console.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "live_stiffness/checks.h"
#include "support/damaged_bag.h"
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
    return loadRecordedBag(path_);
  }
  // Of the file; close the bag before.
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void overwrite(size_t at, const std::string& bytes) const {
    std::fstream file(path_, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(at));
    file << bytes;
  }
  void expectRefused(const std::string& why) const {
    try {
      loadRecordedBag(path_);
      ADD_FAILURE() << "it was read";
    } catch (const ConfigurationError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
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
  BagFormat format{"valves/pressure", "/ndi/tool_1", "nano17", {1e3, true}, 1e-3};
  const Recording recording = loadRecordedBag(path_, format);
  ASSERT_EQ(recording.samples.size(), 1u);
  EXPECT_TRUE(matrixNear(recording.samples[0].pressures, Pressures::Constant(3, 10e3), 1e-6));
  EXPECT_TRUE(matrixNear(recording.samples[0].tip_position, Vector3(0.12, 0.0, 0.0), 1e-12));
  ASSERT_TRUE(recording.samples[0].tip_wrench.has_value());
  EXPECT_THROW(loadRecordedBag(path_), ConfigurationError) << "nothing is on the topics of the node";
}

TEST_F(RecordedBag, WarnsOfUnitsThatNoRobotHas) {
  pressures(10.0, 50.0);  // kPa
  pose(10.1, 20.0);       // mm
  pose(10.2, 50.0);
  const Recording recording = load();
  ASSERT_EQ(recording.warnings.size(), 2u);
  EXPECT_NE(recording.warnings[0].find("moves by 30 m"), std::string::npos) << recording.warnings[0];
  EXPECT_NE(recording.warnings[1].find("above 50 Pa"), std::string::npos) << recording.warnings[1];
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
  ASSERT_EQ(recording.warnings.size(), 2u);
  EXPECT_NE(recording.warnings[0].find("2 messages left out"), std::string::npos) << recording.warnings[0];
  EXPECT_NE(recording.warnings[1].find("1 poses left out"), std::string::npos) << recording.warnings[1];
}

TEST_F(RecordedBag, LeavesOutAMessageThatIsDamaged) {
  threePoses();
  const ros::Time stamp(11.5);
  const Pose X_AS{Matrix3::Identity(), Vector3(0.1, 0.0, 0.0)};
  ASSERT_TRUE(damageSize(path_, toPoseStamped(X_AS, stamp, "aurora"), 1u << 24));
  const Recording recording = loadRecordedBag(path_);
  EXPECT_EQ(recording.samples.size(), 2u);
  ASSERT_EQ(recording.warnings.size(), 1u);
  EXPECT_NE(recording.warnings[0].find("16777216 bytes: must be from 1 to 16384"), std::string::npos) << recording.warnings[0];
}

// rosbag would take it, and read on.
TEST_F(RecordedBag, OfAnotherFormatIsRefused) {
  threePoses();
  overwrite(0, "#ROSBOG");
  expectRefused("must be #ROSBAG V2.0");
}

// rosbag would allocate as much before it looks at what is there.
TEST_F(RecordedBag, WithAChunkOfFourGigabytesIsRefused) {
  threePoses();
  const std::string whole = bytes();
  const size_t header = whole.find("compression=none");
  ASSERT_NE(header, std::string::npos);
  const size_t size = whole.find("size=", header);
  ASSERT_NE(size, std::string::npos);
  overwrite(size + 5, "\xff\xff\xff\xff");
  expectRefused("damaged at byte " + std::to_string(header - 4));
}

// The sums of a compressed chunk say nothing of the index behind it.
TEST_F(RecordedBag, WhoseIndexPointsElsewhereInACompressedChunkIsRefused) {
  for (const rosbag::CompressionType compression : {rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    bag_.close();
    bag_.open(path_, rosbag::bagmode::Write);
    bag_.setCompression(compression);
    threePoses();
    EXPECT_EQ(loadRecordedBag(path_).samples.size(), 3u) << "as it was";
    const std::string version("ver=\x01\0\0\0", 8), whole = bytes();
    const size_t index = whole.find(version, whole.find("compression="));
    ASSERT_NE(index, std::string::npos);
    const size_t entry = index + version.size() + 4, offset = entry + 8;
    overwrite(offset, std::string(1, static_cast<char>(whole[offset] + 3)));
    expectRefused("damaged at byte " + std::to_string(entry));
  }
}

// Read, or refused with a reason, whichever byte is wrong and wherever the file ends.
TEST_F(RecordedBag, IsReadOrRefusedHoweverItIsDamaged) {
  threePoses();
  const std::string whole = bytes();
  int read = 0, refused = 0;
  const auto load = [&](const std::string& bytes) {
    std::ofstream(path_, std::ios::binary) << bytes;
    try {
      loadRecordedBag(path_);
      ++read;
    } catch (const ConfigurationError&) {
      ++refused;
    }
  };
  console_bridge::noOutputHandler();  // of rosbag, a line each
  for (size_t at = 0; at < whole.size(); ++at) {
    if (at > 0 && whole[at] == ' ' && whole[at - 1] == ' ') continue;  // what fills up the bag's header
    std::string damaged = whole;
    damaged[at] ^= "\x01\x80\xff"[at % 3];
    load(damaged);
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
  read = 0;
  for (size_t size = 0; size < whole.size(); size += 29) load(whole.substr(0, size));
  EXPECT_EQ(read, 0);
  console_bridge::restorePreviousOutputHandler();
}

TEST_F(RecordedBag, WithoutASampleIsAConfigurationError) {
  pressures(10.0, 1e4);
  EXPECT_THROW(load(), ConfigurationError);
  EXPECT_THROW(loadRecordedBag(path_ + ".missing"), ConfigurationError);
}

}  // namespace
}  // namespace live_stiffness
