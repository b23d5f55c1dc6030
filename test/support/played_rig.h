#pragma once
// A rig that a test plays to stiffness_node: right pressures and poses, until the test spoils them; and what the node
// says about them.

#include <gtest/gtest.h>

#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/rod/scene_file.h"
#include "support/driven_node.h"
#include "support/watched_diagnostics.h"

namespace live_stiffness {

class PlayedRigTest : public ::testing::Test {
 protected:
  enum Level { kOk = 0, kWarn = 1, kError = 2 };

  PlayedRigTest()
      : model_(loadSceneFile(parameter("scene_file")), ModelOptions()),
        registration_(loadRegistrationFile(parameter("registration_file"))),
        watched_("/stiffness_node"),
        pressures_(node_.advertise<ChamberPressures>("chamber_pressures", 10)),
        poses_(node_.advertise<geometry_msgs::PoseStamped>("aurora_pose", 10)),
        errors_(node_.subscribe<TrackingError>("/stiffness_node/tracking_error", 100,
                                               [this](const TrackingError::ConstPtr&) { ++error_count_; })) {}

  void SetUp() override {
    ASSERT_TRUE(waitFor([&] { return pressures_.getNumSubscribers() > 0 && poses_.getNumSubscribers() > 0; }));
  }
  void TearDown() override { EXPECT_TRUE(watched_.always_finite) << "a published estimate was not finite"; }

  void publishPressures(const Pressures& values) { pressures_.publish(toPressures(values, ros::Time::now())); }
  // Where the tracker sees the sensor of the robot at these pressures; never twice the same, as a tracker is noisy.
  geometry_msgs::PoseStamped seen(const Pressures& values) {
    StiffnessWorkspace workspace = model_.makeWorkspace();
    Pose X_BT = model_.solve(values, Wrench::Zero(), workspace).X_BT;
    X_BT.p.x() += 1e-9 * (++noise_ % 2 + 1);
    return toPoseStamped(registration_.sensorPose(X_BT), ros::Time::now(), "aurora");
  }
  // All is well again: the estimate is that of `values`, and every entry of diagnostics is OK.
  bool recovers(const Pressures& values) {
    const bool recovered = publishUntil(
        [&] {
          publishPressures(values);
          poses_.publish(seen(values));
        },
        [&] { return watched_.solvedFor(values) && is("Pressures", kOk) && is("Tracker", kOk) && is("Solver", kOk); });
    EXPECT_TRUE(recovered) << "Pressures: " << text("Pressures") << "; Tracker: " << text("Tracker")
                           << "; Solver: " << text("Solver");
    return recovered;
  }
  // Level of a task, and a word of its text.
  bool is(const std::string& task, Level level, const std::string& word = "") const {
    return diagnostics_.level(task) == level && text(task).find(word) != std::string::npos;
  }
  std::string text(const std::string& task) const { return diagnostics_.text(task); }

  const Pressures bent_ = pressuresOf({60e3, 60e3, 0.0, 0.0, 0.0, 0.0});
  const Pressures other_ = pressuresOf({0.0, 0.0, 90e3, 90e3, 30e3, 30e3});

  ros::NodeHandle node_;
  StiffnessModel model_;
  Registration registration_;
  Watched watched_;
  ros::Publisher pressures_, poses_;
  WatchedDiagnostics diagnostics_;
  ros::Subscriber errors_;
  long error_count_ = 0;

 private:
  int noise_ = 0;
};

}  // namespace live_stiffness
