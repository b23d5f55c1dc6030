// stiffness_node against the core model, through topics. See node.test for the four nodes.

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Float64MultiArray.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <limits>
#include <map>

#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/rod/scene_file.h"
#include "ros/conversions.h"
#include "support/driven_node.h"
#include "support/watched_diagnostics.h"

namespace live_stiffness {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class StiffnessNodeTest : public ::testing::Test {
 protected:
  StiffnessNodeTest()
      : model_(loadSceneFile(parameter("scene_file")), ModelOptions()),
        watched_("/stiffness_node"),
        pressures_(node_.advertise<ChamberPressures>("chamber_pressures", 10)),
        poses_(node_.advertise<geometry_msgs::PoseStamped>("aurora_pose", 10)),
        wrenches_(node_.advertise<geometry_msgs::WrenchStamped>("tip_wrench", 10)),
        markers_(node_.subscribe("/stiffness_node/markers", 10, &StiffnessNodeTest::onMarkers, this)) {}

  void SetUp() override {
    ASSERT_TRUE(waitFor([&] {
      return pressures_.getNumSubscribers() > 0 && poses_.getNumSubscribers() > 0 && wrenches_.getNumSubscribers() > 0;
    })) << "stiffness_node does not subscribe";
  }

  void TearDown() override { EXPECT_TRUE(watched_.always_finite) << "a published estimate was not finite"; }

  template <class Condition>
  bool publishUntil(const Pressures& values, Condition condition) {
    return live_stiffness::publishUntil([&] { pressures_.publish(toPressures(values, ros::Time::now())); }, condition);
  }

  bool solvedFor(const Pressures& values) const { return watched_.solvedFor(values); }

  StiffnessSolution expected(const Pressures& values, const Wrench& wrench = Wrench::Zero()) const {
    StiffnessWorkspace workspace = model_.makeWorkspace();
    return model_.solve(values, wrench, workspace);
  }

  int level(const std::string& task) const { return diagnostics_.level(task); }
  std::string text(const std::string& task) const { return diagnostics_.text(task); }

  const Pressures bent_ = pressuresOf({60e3, 60e3, 0.0, 0.0, 0.0, 0.0});
  const Pressures other_ = pressuresOf({0.0, 0.0, 90e3, 90e3, 30e3, 30e3});

  ros::NodeHandle node_;
  StiffnessModel model_;
  Watched watched_;
  ros::Publisher pressures_, poses_, wrenches_;
  WatchedDiagnostics diagnostics_;
  ros::Subscriber markers_;
  visualization_msgs::MarkerArray::ConstPtr newest_markers_;

 private:
  void onMarkers(const visualization_msgs::MarkerArray::ConstPtr& message) { newest_markers_ = message; }
};

TEST_F(StiffnessNodeTest, EstimateEqualsCoreModel) {
  ASSERT_TRUE(publishUntil(bent_, [&] { return solvedFor(bent_); }));
  const StiffnessEstimate& estimate = *watched_.estimate;
  const StiffnessSolution solution = expected(bent_);
  // Warm against cold start: both within the model's accuracy of 1e-9.
  EXPECT_LT((positionOf(estimate.tip_pose) - solution.X_BT.p).norm(), 1e-9);
  EXPECT_LT((matrixFrom(estimate.compliance) - solution.compliance).norm(), 1e-8 * solution.compliance.norm());
  EXPECT_LT((matrixFrom(estimate.material_compliance) - solution.material_compliance).norm(),
            1e-8 * solution.material_compliance.norm());
  EXPECT_LT((matrixFrom(estimate.stiffness) * solution.compliance - Matrix6::Identity()).norm(), 1e-6);
  EXPECT_EQ(estimate.status, StiffnessEstimate::OK);
  EXPECT_EQ(estimate.header.frame_id, "base");
  EXPECT_GT(estimate.solve_time, 0.0);
  EXPECT_GT(estimate.iterations, 0);
  EXPECT_LE(estimate.compliance_eigenvalues[0], estimate.compliance_eigenvalues[1]);
  EXPECT_LE(estimate.compliance_eigenvalues[1], estimate.compliance_eigenvalues[2]);
}

TEST_F(StiffnessNodeTest, StampIsThatOfThePressures) {
  ASSERT_TRUE(publishUntil(bent_, [&] { return solvedFor(bent_); }));
  const ros::Time stamp = ros::Time::now() + ros::Duration(0.2);  // after all that were sent, and not now
  pressures_.publish(toPressures(other_, stamp));
  ASSERT_TRUE(waitFor([&] { return solvedFor(other_); }));
  EXPECT_EQ(watched_.estimate->header.stamp, stamp);
}

TEST_F(StiffnessNodeTest, SmallChangeWaitsForTheHeartbeatAndLargeChangeDoesNot) {
  ASSERT_TRUE(publishUntil(bent_, [&] { return solvedFor(bent_); }));
  Pressures near = bent_, far = bent_;
  near[0] += 900.0;  // below update_threshold_pa, 1000
  far[0] += 1100.0;
  const ros::Time sent = ros::Time::now();
  pressures_.publish(toPressures(near, sent));
  ASSERT_TRUE(waitFor([&] { return solvedFor(near); })) << "the heartbeat must take the newest pressures";
  EXPECT_EQ(watched_.estimate->header.stamp, sent);
  pressures_.publish(toPressures(bent_, ros::Time::now()));
  ASSERT_TRUE(publishUntil(bent_, [&] { return solvedFor(bent_); }));
  const long before = watched_.estimates;
  pressures_.publish(toPressures(far, ros::Time::now()));
  ASSERT_TRUE(waitFor([&] { return solvedFor(far); }));
  EXPECT_LE(watched_.estimates - before, 2) << "solved at once, at most one heartbeat before";
}

TEST_F(StiffnessNodeTest, BadPressuresKeepTheLastGoodEstimateMarkedStale) {
  struct Case {
    Pressures values;
    int status;
    std::string word;
  };
  const std::vector<Case> cases = {
      {pressuresOf({kNaN, 0.0, 0.0, 0.0, 0.0, 0.0}), StiffnessEstimate::INVALID_INPUT, "finite"},
      {pressuresOf({1e3, 1e3, 1e3}), StiffnessEstimate::INVALID_INPUT, "channels"},
      {pressuresOf({-2e5, 0.0, 0.0, 0.0, 0.0, 0.0}), StiffnessEstimate::INVALID_INPUT, "-101325"},
      {pressuresOf({3e5, 3e5, 3e5, 3e5, 3e5, 3e5}), StiffnessEstimate::OUT_OF_RANGE, "stretch"},
  };
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.word);
    ASSERT_TRUE(publishUntil(bent_, [&] { return solvedFor(bent_) && level("Pressures") == 0; }));
    ASSERT_TRUE(publishUntil(bad.values, [&] { return watched_.estimate->stale && level("Pressures") == 2; }));
    EXPECT_EQ(watched_.estimate->status, bad.status);
    EXPECT_NE(watched_.estimate->message.find(bad.word), std::string::npos) << watched_.estimate->message;
    EXPECT_NE(text("Pressures").find(bad.word), std::string::npos) << text("Pressures");
    EXPECT_EQ(Pressures::Map(watched_.estimate->pressure.data(), 6), bent_) << "the values of the last good one";
  }
  EXPECT_TRUE(publishUntil(other_, [&] { return solvedFor(other_); })) << "must recover";
}

TEST_F(StiffnessNodeTest, MissingPressuresAreAnErrorAndMakeTheEstimateStale) {
  ASSERT_TRUE(publishUntil(bent_, [&] { return solvedFor(bent_) && level("Pressures") == 0; }));
  EXPECT_TRUE(waitFor([&] { return watched_.estimate->stale && level("Pressures") == 2; }));
  EXPECT_NE(text("Pressures").find("stale"), std::string::npos) << text("Pressures");
}

TEST_F(StiffnessNodeTest, TrackingErrorIsMeasuredAgainstPredictedTip) {
  const Registration registration = loadRegistrationFile(parameter("registration_file"));
  Pose X_BT = expected(bent_).X_BT;
  X_BT.p += Vector3(0.001, 0.0, 0.002);
  auto pose = toPoseStamped(registration.sensorPose(X_BT), ros::Time::now(), "/aurora");  // with a leading slash
  ASSERT_TRUE(publishUntil(bent_, [&] {
    pose.header.stamp = ros::Time::now();
    pose.pose.position.x += 1e-9;  // a pose that repeats itself is that of a lost sensor
    poses_.publish(pose);
    return solvedFor(bent_) && watched_.force && watched_.error && std::abs(watched_.error->distance - std::sqrt(5e-6)) < 1e-6;
  }));
  EXPECT_NEAR(watched_.error->translation.x, 0.001, 1e-6);
  ASSERT_TRUE(watched_.force);  // published with every tracking error
  EXPECT_EQ(watched_.force->header.frame_id, "base");
  // Of a small lasting error most is the model's; what counts as force pushes the way the tip is off.
  EXPECT_GT(watched_.force->wrench.force.x, 0.0);
  EXPECT_NEAR(watched_.error->translation.z, 0.002, 1e-6);
  EXPECT_LT(watched_.error->angle, 1e-6);
}

TEST_F(StiffnessNodeTest, UnusableTrackerPosesAreAWarningAndEstimatesGoOn) {
  const auto good = toPoseStamped(Pose(), ros::Time::now(), "aurora");
  auto zero_quaternion = good, unknown_frame = good, not_finite = good;
  zero_quaternion.pose.orientation.w = 0.0;
  unknown_frame.header.frame_id = "camera";
  not_finite.pose.position.x = kNaN;
  const std::map<std::string, geometry_msgs::PoseStamped> cases = {
      {"quaternion is zero", zero_quaternion}, {"unknown frame camera", unknown_frame}, {"not finite", not_finite}};
  for (const auto& [word, pose] : cases) {
    SCOPED_TRACE(word);
    EXPECT_TRUE(publishUntil(bent_, [&, pose = pose, word = word] {
      poses_.publish(pose);
      return text("Tracker").find(word) != std::string::npos && level("Tracker") == 1;
    })) << text("Tracker");
    EXPECT_TRUE(publishUntil(other_, [&] { return solvedFor(other_); }));
    EXPECT_TRUE(publishUntil(bent_, [&] { return solvedFor(bent_); }));
  }
  EXPECT_TRUE(publishUntil(bent_, [&] {
    poses_.publish(good);
    return text("Tracker").find("repeats") != std::string::npos;
  })) << "a tracker that repeats itself has lost its sensor";
  EXPECT_TRUE(publishUntil(bent_, [&] { return text("Tracker").find("stale") != std::string::npos; }));
}

TEST_F(StiffnessNodeTest, TipWrenchActsInItsFrameAndExpires) {
  Wrench wrench;
  wrench << 0.05, -0.02, 0.1, 0.0, 0.0, 0.0;
  const StiffnessSolution free = expected(bent_), pushed = expected(bent_, wrench);
  const auto tip_is_at = [&](const StiffnessSolution& solution) {
    return solvedFor(bent_) && (positionOf(watched_.estimate->tip_pose) - solution.X_BT.p).norm() < 1e-7;
  };
  ASSERT_TRUE(publishUntil(bent_, [&] { return tip_is_at(free); }));
  EXPECT_TRUE(publishUntil(bent_, [&] {
    wrenches_.publish(toWrenchStamped(wrench, ros::Time::now(), "/base"));
    return tip_is_at(pushed);
  }));
  EXPECT_TRUE(publishUntil(bent_, [&] { return tip_is_at(free); })) << "after tip_wrench_timeout_s it counts as zero";
  EXPECT_TRUE(publishUntil(bent_, [&] {
    wrenches_.publish(toWrenchStamped(wrench, ros::Time::now(), "elsewhere"));
    return text("Solver").find("unknown frame elsewhere") != std::string::npos;
  }));
  EXPECT_TRUE(tip_is_at(free));
}

TEST_F(StiffnessNodeTest, TransformAndMarkersShowTheEstimate) {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  const StiffnessSolution solution = expected(bent_);
  ASSERT_TRUE(publishUntil(bent_, [&] {
    return solvedFor(bent_) && newest_markers_ && newest_markers_->markers.size() > 5 &&
           buffer.canTransform("base", "tip", ros::Time(0)) &&
           std::abs(buffer.lookupTransform("base", "tip", ros::Time(0)).transform.translation.x -
                    solution.X_BT.p.x()) < 1e-7;
  }));
  std::map<std::string, int> count;
  for (const auto& marker : newest_markers_->markers) {
    if (marker.action != visualization_msgs::Marker::ADD) continue;  // of what another test has seen
    ++count[marker.ns];
    EXPECT_EQ(marker.header.frame_id, "base");
    EXPECT_GT(marker.scale.x, 0.0);
    const auto& q = marker.pose.orientation;
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-9);
  }
  EXPECT_EQ(count["ellipsoids"], 5);
  EXPECT_EQ(count["tip_ellipsoid"], 1);
  EXPECT_EQ(count["backbone"], 1);
  EXPECT_EQ(count["text"], 1);
}

// Publishes to a node of node.test until its estimate is that of `chambers`.
template <class Publish>
bool reaches(Watched& watched, const Pressures& chambers, Publish publish) {
  return waitFor([&] {
    publish();
    return watched.estimate && !watched.estimate->stale && watched.estimate->pressure.size() == 6 &&
           (Pressures::Map(watched.estimate->pressure.data(), 6) - chambers).norm() < 0.1;  // float32 keeps 7 digits
  });
}

TEST_F(StiffnessNodeTest, ArraysInAbsoluteKilopascalOnThreeChannelsAndTransformInMillimetres) {
  Watched watched("/arrays_node");
  ros::Publisher publisher = node_.advertise<std_msgs::Float64MultiArray>("arrays/pressures", 10);
  ros::Publisher poses = node_.advertise<geometry_msgs::TransformStamped>("arrays/pose", 10);
  std_msgs::Float64MultiArray message;
  message.data = {161.325, 101.325, 101.325};
  Pose X_BT = expected(bent_).X_BT;
  X_BT.p *= 1000.0;
  EXPECT_TRUE(reaches(watched, bent_, [&] {
    publisher.publish(message);
    X_BT.p.x() += 1e-9;  // a pose that repeats itself is that of a lost sensor
    poses.publish(toTransform(X_BT, ros::Time::now(), "aurora", "aurora_tip"));
  }));
  EXPECT_TRUE(waitFor([&] {
    publisher.publish(message);
    X_BT.p.x() += 1e-9;  // a pose that repeats itself is that of a lost sensor
    poses.publish(toTransform(X_BT, ros::Time::now(), "aurora", "aurora_tip"));
    return watched.error && watched.error->distance < 1e-6;
  }));
  message.data[0] = -1.0;  // negative absolute pressure
  EXPECT_TRUE(waitFor([&] {
    publisher.publish(message);
    return watched.estimate->stale && watched.estimate->message.find("negative") != std::string::npos;
  }));
  EXPECT_TRUE(watched.always_finite);
}

TEST_F(StiffnessNodeTest, FloatArraysInPsiAndSensorInTf) {
  Watched watched("/tf_node");
  ros::Publisher publisher = node_.advertise<std_msgs::Float32MultiArray>("tf/pressures", 10);
  tf2_ros::TransformBroadcaster broadcaster;
  std_msgs::Float32MultiArray message;
  const float psi = static_cast<float>(60e3 / 6894.757293168361);
  message.data = {psi, psi, 0.0f, 0.0f, 0.0f, 0.0f};
  EXPECT_TRUE(reaches(watched, bent_, [&] { publisher.publish(message); }));
  Pose X_BT = expected(bent_).X_BT;
  EXPECT_TRUE(waitFor([&] {
    publisher.publish(message);
    X_BT.p.x() += 1e-9;  // a pose that repeats itself is that of a lost sensor
    broadcaster.sendTransform(toTransform(X_BT, ros::Time::now(), "aurora", "aurora_sensor"));
    return watched.error && watched.error->distance < 1e-6;
  }));
}

TEST_F(StiffnessNodeTest, OneFluidPressureTopicPerChannelAndPoseWithCovariance) {
  Watched watched("/fluid_node");
  std::vector<ros::Publisher> publishers;
  for (int k = 1; k <= 3; ++k)
    publishers.push_back(node_.advertise<sensor_msgs::FluidPressure>("regulator_" + std::to_string(k), 10));
  ros::Publisher poses = node_.advertise<geometry_msgs::PoseWithCovarianceStamped>("fluid/pose", 10);
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.frame_id = "aurora_tip";  // a driver that names the child frame
  pose.pose.pose = toPose(expected(bent_).X_BT);
  const auto publish = [&] {
    for (size_t k = 0; k < publishers.size(); ++k) {
      sensor_msgs::FluidPressure message;
      message.header.stamp = ros::Time::now();
      message.fluid_pressure = k == 0 ? 60e3 : 0.0;
      publishers[k].publish(message);
    }
    pose.header.stamp = ros::Time::now();
    pose.pose.pose.position.x += 1e-9;  // a pose that repeats itself is that of a lost sensor
    poses.publish(pose);
  };
  EXPECT_TRUE(reaches(watched, bent_, publish));
  EXPECT_TRUE(waitFor([&] {
    publish();
    return watched.error && watched.error->distance < 1e-6;
  }));
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
