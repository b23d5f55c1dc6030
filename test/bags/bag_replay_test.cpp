#include "bags/bag_replay.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/Float64MultiArray.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "live_stiffness/checks.h"
#include "ros/conversions.h"
#include "estimation/creep.h"
#include "support/matrix_near.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

constexpr double kRate = 40.0;  // Hz

// A bag of a robot that follows the model, seen by a tracker that stands elsewhere.
class BagReplay : public ::testing::Test {
 protected:
  BagReplay() : model_(paperScene(1), ModelOptions()), in_(path("in")), out_(path("out")) {
    parameters_.scene = model_.scene();
    parameters_.registration.X_AB = {expSo3(Vector3(0.1, -0.4, 2.0)), Vector3(0.2, -0.1, 0.3)};
    parameters_.registration.X_TS.p = Vector3(0.01, 0.0, 0.02);
    parameters_.is_registered = true;
    topics_.wrench = "tip_wrench";
    bag_.open(in_, rosbag::bagmode::Write);
  }
  ~BagReplay() override {
    std::remove(in_.c_str());
    std::remove(out_.c_str());
  }
  static std::string path(const std::string& name) {
    return std::string(::testing::TempDir()) + "bag_replay_" +
           ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name + ".bag";
  }
  static ros::Time stamp(double time) { return ros::Time(100.0 + time); }
  Pressures at(double time) const {
    Pressures pressures = Pressures::Zero(model_.scene().chamberCount());
    pressures[0] = pressures[1] = 4e4 * (1.0 - std::cos(time));
    return pressures;
  }
  void record(double time, double tip_error = 0.0, double delay = 0.0) {
    StiffnessWorkspace workspace = model_.makeWorkspace();
    bag_.write("/chamber_pressures", stamp(time), toPressures(at(time), stamp(time)));
    Pose X_BT = model_.solve(at(time - delay), Wrench::Zero(), workspace).X_BT;
    X_BT.p.x() += tip_error;
    const ros::Time seen = stamp(time + 1e-3);  // messages of one time come in no certain order
    bag_.write("aurora_pose", seen, toPoseStamped(parameters_.registration.sensorPose(X_BT), seen, "aurora"));
  }
  ReplayReport replay() {
    bag_.close();
    return again();
  }
  ReplayReport again(const std::string& in = "", const std::string& out = "") {
    return replayBags({in.empty() ? in_ : in}, out.empty() ? out_ : out, parameters_, topics_);
  }

  StiffnessModel model_;
  NodeParameters parameters_;
  BagTopics topics_;
  std::string in_, out_;
  rosbag::Bag bag_;
};

TEST_F(BagReplay, WritesTheEstimatesOfTheModelWithTheStampsOfTheirPressures) {
  parameters_.estimator.update_threshold = 0.0;
  parameters_.heartbeat = 0.1;  // not while the bag lasts
  for (int i = 0; i < 80; ++i) record(i / kRate);
  const ReplayReport report = replay();
  EXPECT_EQ(report.updates, 80);
  rosbag::Bag out(out_, rosbag::bagmode::Read);
  StiffnessWorkspace workspace = model_.makeWorkspace();
  int count = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(out, rosbag::TopicQuery("/stiffness_node/estimate"))) {
    const auto estimate = message.instantiate<StiffnessEstimate>();
    ASSERT_TRUE(estimate);
    EXPECT_FALSE(estimate->stale);
    const double time = count++ / kRate;
    EXPECT_NEAR((estimate->header.stamp - stamp(time)).toSec(), 0.0, 1e-6);
    workspace.reset();
    const StiffnessSolution exact = model_.solve(at(time), Wrench::Zero(), workspace);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)  // two solves, each accurate to 1e-9
        EXPECT_NEAR(estimate->compliance[6 * i + j], exact.compliance(i, j), 1e-8 * exact.compliance.norm());
  }
  EXPECT_EQ(count, 80);
}

TEST_F(BagReplay, ReportsTheTrackingError) {
  parameters_.estimator.update_threshold = 0.0;
  for (int i = 0; i < 40; ++i) record(i / kRate, 2e-3);
  const ReplayReport report = replay();
  EXPECT_EQ(report.tracking_error.count, 40);
  EXPECT_NEAR(report.tracking_error.mean, 2e-3, 1e-9);
  EXPECT_NEAR(report.tracking_error.max, 2e-3, 1e-9);
  EXPECT_NE(report.text(in_, parameters_).find("mean 2.00"), std::string::npos) << report.text(in_, parameters_);
}

TEST_F(BagReplay, ComparesALateTrackerWithTheRobotOfThatTime) {
  parameters_.estimator.update_threshold = 0.0;
  for (int i = 0; i < 200; ++i) record(i / kRate, 0.0, 0.15);
  parameters_.registration.tracker_delay = 0.15;
  const ReplayReport report = replay();
  EXPECT_EQ(report.tracking_error.count, 200);
  // Poses are stamped a millisecond late, at up to 40 mm/s; the first six are of a time before the bag.
  EXPECT_LT(report.tracking_error.p95, 0.1e-3);
  parameters_.registration.tracker_delay = 0.0;
  EXPECT_GT(again().tracking_error.mean, 0.5e-3);
}

TEST_F(BagReplay, CreepsAsTheSceneDoes) {
  parameters_.estimator.update_threshold = 0.0;
  Scene scene = model_.scene();
  Material& material = std::get<Segment>(scene.chain.front()).section.material;
  material.creep_share = 0.2;
  material.creep_time = 1.5;
  SceneCreep creep(scene);
  StiffnessWorkspace workspace = model_.makeWorkspace();
  for (int i = 0; i < 200; ++i) {
    const ros::Time now = stamp(i / kRate);
    bag_.write("/chamber_pressures", now, toPressures(at(i / kRate), now));
    const Pressures& effective = creep.update(at(i / kRate), now.toSec());
    const Pose X_BT = model_.solve(effective, Wrench::Zero(), workspace).X_BT;
    bag_.write("aurora_pose", now + ros::Duration(1e-3),
               toPoseStamped(parameters_.registration.sensorPose(X_BT), now + ros::Duration(1e-3), "aurora"));
  }
  EXPECT_GT(replay().tracking_error.mean, 0.5e-3);
  parameters_.scene = scene;
  EXPECT_LT(again().tracking_error.max, 1e-7);  // accuracy of the solver
}

TEST_F(BagReplay, ReportsRatesAndTheLongestGap) {
  for (int i = 0; i < 40; ++i) record(i / kRate);
  for (int i = 60; i < 80; ++i) record(i / kRate);
  const ReplayReport report = replay();
  for (const TopicReport* topic : {&report.pressures, &report.poses}) {
    EXPECT_EQ(topic->accepted, 60);
    EXPECT_NEAR(topic->rate, kRate, 1e-3);
    EXPECT_NEAR(topic->longest_gap, 21.0 / kRate, 1e-6);
    EXPECT_NEAR(topic->gap_start, 39.0 / kRate, 1.1e-3);  // poses come a millisecond later
    EXPECT_EQ(topic->out_of_order, 0);
  }
  EXPECT_NEAR(report.duration, 79.0 / kRate + 1e-3, 1e-6);
}

TEST_F(BagReplay, CountsWhatItCannotUseAndGoesOn) {
  record(0.0);
  Pressures bad = at(0.1);
  bad[2] = std::nan("");
  bag_.write("/chamber_pressures", stamp(0.1), toPressures(bad, stamp(0.1)));
  bag_.write("/chamber_pressures", stamp(0.2), toPressures(Pressures::Zero(5), stamp(0.2)));
  bag_.write("/chamber_pressures", stamp(0.3), toPoseStamped(Pose(), stamp(0.3), ""));
  bag_.write("/aurora_pose", stamp(0.3), geometry_msgs::PoseStamped());  // a zero quaternion
  bag_.write("/tip_wrench", stamp(0.3), toWrenchStamped(Wrench::Zero(), stamp(0.3), "elsewhere"));
  Pressures far = Pressures::Constant(model_.scene().chamberCount(), 5e7);
  bag_.write("/chamber_pressures", stamp(0.4), toPressures(far, stamp(0.4)));
  record(0.5);
  const ReplayReport report = replay();
  EXPECT_EQ(report.pressures.accepted, 3);
  EXPECT_EQ(report.pressures.rejected, 4) << "with those that have no solution, as the node counts";
  EXPECT_EQ(report.poses.rejected, 1);
  EXPECT_EQ(report.wrenches.rejected, 1);
  EXPECT_EQ(report.failures, 1);
  EXPECT_EQ(report.updates, 2);
  EXPECT_FALSE(report.first_failure.empty());
  EXPECT_EQ(report.tracking_error.count, 2);
  rosbag::Bag out(out_, rosbag::bagmode::Read);
  for (const rosbag::MessageInstance& message : rosbag::View(out, rosbag::TopicQuery("/stiffness_node/estimate"))) {
    const auto estimate = message.instantiate<StiffnessEstimate>();
    for (double c : estimate->compliance) EXPECT_TRUE(std::isfinite(c));
  }
}

TEST_F(BagReplay, TakesAKnownTipWrench) {
  parameters_.estimator.update_threshold = 0.0;
  record(0.0);
  const Wrench wrench = 0.3 * Wrench::Unit(0);
  bag_.write("/tip_wrench", stamp(0.1), toWrenchStamped(wrench, stamp(0.1), "base"));
  EXPECT_EQ(replay().updates, 2);
  rosbag::Bag out(out_, rosbag::bagmode::Read);
  StiffnessEstimate last;
  for (const rosbag::MessageInstance& message : rosbag::View(out, rosbag::TopicQuery("/stiffness_node/estimate")))
    last = *message.instantiate<StiffnessEstimate>();
  StiffnessWorkspace workspace = model_.makeWorkspace();
  EXPECT_NEAR(last.tip_pose.position.x, model_.solve(at(0.0), wrench, workspace).X_BT.p.x(), 1e-9);
}

// As the node does: what feeds which chamber is not guessed.
TEST_F(BagReplay, RefusesAnotherNumberOfChannelsUnlessToldWhichFeedsWhich) {
  Pressures three(3);
  three << 1e4, 3e4, 5e4;
  bag_.write("/chamber_pressures", stamp(0.0), toPressures(three, stamp(0.0)));
  EXPECT_THROW(replay(), ConfigurationError);
  parameters_.channel_of_chamber = {0, 0, 1, 1, 2, 2};
  EXPECT_EQ(again().updates, 1);
}

TEST_F(BagReplay, ComparesNothingWithoutARegistration) {
  for (int i = 0; i < 40; ++i) record(i / kRate);
  parameters_.is_registered = false;
  const ReplayReport report = replay();
  EXPECT_EQ(report.tracking_error.count, 0);
  EXPECT_EQ(report.contacts, 0);
  EXPECT_NE(report.text(in_, parameters_).find("not registered"), std::string::npos);
}

// Seconds since the device was switched on.
TEST_F(BagReplay, UsesTheTimeOfRecordingWhereAStampIsOfAnotherClock) {
  parameters_.estimator.update_threshold = 0.0;
  for (int i = 0; i < 80; ++i) {
    bag_.write("/chamber_pressures", stamp(i / kRate), toPressures(at(i / kRate), ros::Time(12.5 + i / kRate)));
    StiffnessWorkspace workspace = model_.makeWorkspace();
    const Pose X_BT = model_.solve(at(i / kRate), Wrench::Zero(), workspace).X_BT;
    const ros::Time seen = stamp(i / kRate + 1e-3);
    bag_.write("/aurora_pose", seen, toPoseStamped(parameters_.registration.sensorPose(X_BT), seen, "aurora"));
  }
  const ReplayReport report = replay();
  EXPECT_EQ(report.tracking_error.count, 80);
  EXPECT_LT(report.tracking_error.max, 1e-7);
  EXPECT_NE(report.text(in_, parameters_).find("stamps are not in ROS time"), std::string::npos);
}

TEST_F(BagReplay, MarksEstimatesStaleWhilePressuresAreSilent) {
  for (int i = 0; i < 40; ++i) record(i / kRate);
  for (int i = 40; i < 240; ++i) {  // poses go on
    const ros::Time seen = stamp(i / kRate);
    const Pose X_AS{expSo3(0.1 * Vector3::UnitX()), Vector3(0.2, 1e-3 * i, 0.3)};
    bag_.write("/aurora_pose", seen, toPoseStamped(X_AS, seen, "aurora"));
  }
  const ReplayReport report = replay();
  EXPECT_NEAR(static_cast<double>(report.stale_estimates), 4.0, 1.0) << "one a heartbeat";
  EXPECT_NEAR(static_cast<double>(report.tracking_error.count), 40.0 + kPressureTimeout.standard * kRate, 2.0);
}

// A tool that is lost while its driver repeats the last pose.
TEST_F(BagReplay, ComparesNothingWithARepeatedPose) {
  for (int i = 0; i < 40; ++i) record(i / kRate);
  for (int i = 40; i < 240; ++i) {
    bag_.write("/chamber_pressures", stamp(i / kRate), toPressures(at(i / kRate), stamp(i / kRate)));
    const ros::Time seen = stamp(i / kRate + 1e-3);
    bag_.write("/aurora_pose", seen, toPoseStamped(parameters_.registration.sensorPose(Pose()), seen, "aurora"));
  }
  EXPECT_LE(replay().tracking_error.count, 40 + 1 + static_cast<int>(kPoseTimeout.standard * kRate));
}

// One FluidPressure topic a valve, of which one stops.
TEST_F(BagReplay, NamesASilentValve) {
  parameters_.pressure_topics = {"valve_1", "valve_2"};
  parameters_.channel_of_chamber = {0, 0, 0, 1, 1, 1};
  for (int i = 0; i < 120; ++i)
    for (int valve : {1, 2}) {
      sensor_msgs::FluidPressure message;
      message.header.stamp = stamp(i / kRate);
      message.fluid_pressure = 1e4;
      if (valve == 1 || i < 40) bag_.write("/valve_" + std::to_string(valve), stamp(i / kRate), message);
    }
  const ReplayReport report = replay();
  EXPECT_GT(report.stale_estimates, 0);
  EXPECT_NE(report.text(in_, parameters_).find("valve_2 is silent for 0.5"), std::string::npos)
      << report.text(in_, parameters_);
}

TEST_F(BagReplay, LetsAKnownWrenchEndAfterItsTimeout) {
  for (int i = 0; i < 200; ++i) {
    record(i / kRate);
    if (i < 40) bag_.write("/tip_wrench", stamp(i / kRate), toWrenchStamped(0.3 * Wrench::Unit(0), stamp(i / kRate), "base"));
  }
  replay();
  rosbag::Bag out(out_, rosbag::bagmode::Read);
  double first = -1.0, last = -1.0;
  for (const rosbag::MessageInstance& message : rosbag::View(out, rosbag::TopicQuery("/stiffness_node/estimate"))) {
    last = message.instantiate<StiffnessEstimate>()->tip_wrench.force.x;
    first = std::max(first, last);
  }
  EXPECT_EQ(first, 0.3);
  EXPECT_EQ(last, 0.0);
}

TEST_F(BagReplay, TakesTheSensorFromTfAndLeavesOtherToolsAlone) {
  for (int i = 0; i < 40; ++i) {
    bag_.write("/chamber_pressures", stamp(i / kRate), toPressures(at(i / kRate), stamp(i / kRate)));
    StiffnessWorkspace workspace = model_.makeWorkspace();
    const Pose X_BT = model_.solve(at(i / kRate), Wrench::Zero(), workspace).X_BT;
    const ros::Time seen = stamp(i / kRate + 1e-3);
    tf2_msgs::TFMessage tf;
    tf.transforms = {toTransform(parameters_.registration.sensorPose(X_BT), seen, "aurora", "tool_1"),
                     toTransform(Pose(), seen, "aurora", "aurora_tip")};
    bag_.write("/tf", seen, tf);
    for (const auto& transform : tf.transforms) bag_.write("/aurora_pose", seen, transform);
  }
  parameters_.estimator.update_threshold = 0.0;
  parameters_.tracker_tf_frame = "tool_1";
  ReplayReport report = replay();
  EXPECT_EQ(report.tracking_error.count, 40);
  EXPECT_LT(report.tracking_error.max, 1e-7);
  parameters_.tracker_tf_frame = "";
  parameters_.sensor_frame = "tool_1";
  report = again();
  EXPECT_EQ(report.tracking_error.count, 40);
  EXPECT_LT(report.tracking_error.max, 1e-7);
  EXPECT_NE(report.text(in_, parameters_).find("left out other tools: aurora_tip (40 poses)"), std::string::npos)
      << report.text(in_, parameters_);
}

TEST_F(BagReplay, RefusesBagsThatCannotBe) {
  bag_.close();
  EXPECT_THROW(replay(), ConfigurationError);  // no pressures
  EXPECT_THROW(again(in_, in_), ConfigurationError);
  EXPECT_THROW(again("/nowhere.bag"), std::runtime_error);
  EXPECT_THROW(again(in_, "/nowhere/out.bag"), ConfigurationError);
  std::ofstream(in_) << "no bag";
  EXPECT_THROW(again(), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(out_));
}

}  // namespace
}  // namespace live_stiffness
