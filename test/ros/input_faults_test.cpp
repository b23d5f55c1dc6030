// What rigs do to stiffness_node: whatever comes in, it lives on, publishes nothing old as new, says in /diagnostics
// what is wrong, and that all is well again afterwards.

#include <limits>

#include "support/played_rig.h"

namespace live_stiffness {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using PressureFaults = PlayedRigTest;
using TrackerFaults = PlayedRigTest;

TEST_F(PressureFaults, Stop) {
  ASSERT_TRUE(recovers(bent_));
  EXPECT_TRUE(waitFor([&] { return watched_.estimate->stale && is("Pressures", kError, "stale"); }));
  recovers(other_);
}

TEST_F(PressureFaults, JumpFromOneExtremeToTheOther) {
  const std::vector<double> left = {120e3, 120e3, 0.0, 0.0, 0.0, 0.0}, right = {0.0, 0.0, 0.0, 0.0, 120e3, 120e3};
  for (const std::vector<double>& each : {left, right, left, std::vector<double>(6, 0.0), right}) {
    const Pressures values = pressuresOf(each);
    ASSERT_TRUE(recovers(values));
    StiffnessWorkspace workspace = model_.makeWorkspace();
    const Pose X_BT = model_.solve(values, Wrench::Zero(), workspace).X_BT;
    // Warm against cold start: both within the model's accuracy of 1e-9.
    EXPECT_LT((positionOf(watched_.estimate->tip_pose) - X_BT.p).norm(), 1e-9);
  }
}

TEST_F(PressureFaults, NotFiniteOrOfAnotherNumber) {
  const std::map<std::string, Pressures> cases = {
      {"finite", pressuresOf({kNaN, 0.0, 0.0, 0.0, 0.0, 0.0})},
      {"must be finite", pressuresOf({0.0, 0.0, 0.0, 0.0, 0.0, std::numeric_limits<double>::infinity()})},
      {"3 channels: must be 6", pressuresOf({1e3, 1e3, 1e3})},
      {"0 channels", pressuresOf({})}};
  for (const auto& [word, values] : cases) {
    SCOPED_TRACE(word);
    ASSERT_TRUE(recovers(bent_));
    EXPECT_TRUE(publishUntil([&, values = values] { publishPressures(values); }, [&, word = word] {
      return watched_.estimate->stale && is("Pressures", kError, word);
    })) << text("Pressures");
  }
  recovers(other_);
}

TEST_F(PressureFaults, OutOfOrderOnesAreLeftOut) {
  ASSERT_TRUE(recovers(bent_));
  bool went_back = false;
  EXPECT_TRUE(publishUntil(
      [&] {
        const ros::Time now = ros::Time::now();
        pressures_.publish(toPressures(bent_, now));
        pressures_.publish(toPressures(other_, now - ros::Duration(0.2)));  // was overtaken
      },
      [&] {
        went_back = went_back || watched_.solvedFor(other_);
        return is("Pressures", kWarn, "out of order");
      })) << text("Pressures");
  EXPECT_FALSE(went_back) << "older pressures were published as the newest";
  recovers(bent_);
}

TEST_F(PressureFaults, StampsOfTheFutureAreReplaced) {
  ASSERT_TRUE(recovers(bent_));
  EXPECT_TRUE(publishUntil([&] { pressures_.publish(toPressures(other_, ros::Time::now() + ros::Duration(5.0))); },
                           [&] { return watched_.solvedFor(other_) && is("Pressures", kWarn, "ahead"); }))
      << text("Pressures");
  EXPECT_LE(watched_.estimate->header.stamp, ros::Time::now());
  recovers(bent_);
}

TEST_F(PressureFaults, ThoseThatComeSecondsLateAreStale) {
  ASSERT_TRUE(recovers(bent_));
  bool fresh = false;
  EXPECT_TRUE(publishUntil([&] { pressures_.publish(toPressures(other_, ros::Time::now() - ros::Duration(3.0))); },
                           [&] {
                             fresh = fresh || watched_.solvedFor(other_);
                             return watched_.estimate->stale && is("Pressures", kError, "stale");
                           }))
      << text("Pressures");
  EXPECT_FALSE(fresh) << "pressures of three seconds ago were published as fresh";
  recovers(bent_);
}

TEST_F(TrackerFaults, DropOut) {
  ASSERT_TRUE(recovers(bent_));
  EXPECT_TRUE(publishUntil([&] { publishPressures(bent_); }, [&] { return is("Tracker", kWarn, "stale"); }));
  EXPECT_TRUE(watched_.solvedFor(bent_)) << "estimates do not need the tracker";
  recovers(other_);
}

TEST_F(TrackerFaults, RepeatedPosesAreNoMeasurement) {
  ASSERT_TRUE(recovers(bent_));
  auto pose = seen(bent_);
  const auto repeat = [&] {
    publishPressures(bent_);
    pose.header.stamp = ros::Time::now();
    poses_.publish(pose);
  };
  ASSERT_TRUE(publishUntil(repeat, [&] { return is("Tracker", kWarn, "repeats"); })) << text("Tracker");
  const long before = error_count_, estimates = watched_.estimates;
  ASSERT_TRUE(publishUntil(repeat, [&] { return watched_.estimates > estimates + 5; }));
  EXPECT_EQ(error_count_, before) << "the error of a sensor that was lost was published as a new one";
  recovers(other_);
}

TEST_F(TrackerFaults, MillimetresZeroQuaternionsAndForeignFrames) {
  ASSERT_TRUE(recovers(bent_));
  using Spoil = std::function<void(geometry_msgs::PoseStamped&)>;
  const std::map<std::string, Spoil> cases = {
      {"millimetres?",
       [](auto& m) {
         for (double* value : {&m.pose.position.x, &m.pose.position.y, &m.pose.position.z}) *value *= 1000.0;
       }},
      {"quaternion is zero", [](auto& m) { m.pose.orientation = geometry_msgs::Quaternion(); }},
      {"not finite", [](auto& m) { m.pose.position.y = kNaN; }},
      {"unknown frame camera", [](auto& m) { m.header.frame_id = "/camera"; }}};
  for (const auto& [word, spoil] : cases) {
    SCOPED_TRACE(word);
    ASSERT_TRUE(recovers(bent_));
    const auto publish = [&, spoil = spoil] {
      publishPressures(bent_);
      auto pose = seen(bent_);
      spoil(pose);
      poses_.publish(pose);
    };
    ASSERT_TRUE(publishUntil(publish, [&, word = word] { return is("Tracker", kWarn, word); })) << text("Tracker");
    const long before = error_count_, estimates = watched_.estimates;
    ASSERT_TRUE(publishUntil(publish, [&] { return watched_.estimates > estimates + 3; }));
    EXPECT_EQ(error_count_, before) << "a tracking error was made of it";
    EXPECT_TRUE(watched_.solvedFor(bent_)) << "estimates do not need the tracker";
  }
  recovers(other_);
}

TEST_F(TrackerFaults, FlippedQuaternionSignsAndLeadingSlashesAreHarmless) {
  ASSERT_TRUE(recovers(bent_));
  const long before = error_count_;
  double worst = 0.0;
  int count = 0;
  bool warned = false;
  EXPECT_TRUE(publishUntil(
      [&] {
        publishPressures(bent_);
        auto pose = seen(bent_);
        pose.header.frame_id = count % 3 == 0 ? "/aurora" : count % 3 == 1 ? "/aurora_tip" : "";
        if (count++ % 2 == 0)
          for (double* q : {&pose.pose.orientation.w, &pose.pose.orientation.x, &pose.pose.orientation.y,
                            &pose.pose.orientation.z})
            *q = -*q;
        poses_.publish(pose);
      },
      [&] {
        // The first ones may still be of a pose of the test before.
        if (error_count_ > before + 3) worst = std::max({worst, watched_.error->distance, watched_.error->angle});
        warned = warned || !is("Tracker", kOk);
        return error_count_ > before + 20;
      }));
  EXPECT_FALSE(warned) << text("Tracker");
  EXPECT_LT(worst, 1e-6) << "a flip is no turn";
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "input_faults_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
