// parallel_node against the core model, through topics. See parallel_node.test for the nodes.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/String.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "live_stiffness/PlatformEstimate.h"
#include "live_stiffness/RodLengths.h"
#include "live_stiffness/parallel/parallel_model.h"
#include "live_stiffness/parallel/parallel_scene_file.h"
#include "support/driven_node.h"

namespace live_stiffness {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Lengths = std::vector<double>;

class ParallelNodeTest : public ::testing::Test {
 protected:
  ParallelNodeTest()
      : model_(loadParallelSceneFile(parameter("scene_file")), ParallelOptions()),
        lengths_(node_.advertise<RodLengths>("rod_lengths", 10)),
        wrenches_(node_.advertise<geometry_msgs::WrenchStamped>("platform_wrench", 10)),
        estimates_(node_.subscribe("/parallel_node/estimate", 100, &ParallelNodeTest::onEstimate, this)),
        diagnostics_(node_.subscribe("/diagnostics", 100, &ParallelNodeTest::onDiagnostics, this)),
        markers_(node_.subscribe("/parallel_node/markers", 10, &ParallelNodeTest::onMarkers, this)) {}

  void SetUp() override {
    ASSERT_TRUE(waitFor([&] { return lengths_.getNumSubscribers() > 0 && wrenches_.getNumSubscribers() > 0; }))
        << "parallel_node does not subscribe";
  }
  void TearDown() override { EXPECT_TRUE(always_finite_) << "a published estimate was not finite"; }

  static RodLengths messageOf(const Lengths& lengths) {
    RodLengths message;
    message.header.stamp = ros::Time::now();
    message.length = lengths;
    return message;
  }
  template <class Condition>
  bool driveUntil(const Lengths& lengths, Condition condition) {
    return publishUntil([&] { lengths_.publish(messageOf(lengths)); }, condition);
  }
  bool solvedFor(const Lengths& lengths) const {
    return estimate_ && !estimate_->stale && estimate_->length == lengths;
  }
  ParallelSolution expected(const Lengths& lengths, const Wrench& wrench = Wrench::Zero()) const {
    ParallelWorkspace workspace = model_.makeWorkspace();
    return model_.solve(lengths, wrench, workspace);
  }
  bool isAt(const Pose& X_BP, double tolerance = 1e-7) const {
    return estimate_ && !estimate_->stale && (positionOf(estimate_->platform_pose) - X_BP.p).norm() < tolerance;
  }

  const Lengths leaning_ = {0.40, 0.41, 0.405, 0.42, 0.415, 0.41}, straight_ = Lengths(6, 0.45);

  ros::NodeHandle node_;
  ParallelModel model_;
  ros::Publisher lengths_, wrenches_;
  ros::Subscriber estimates_, diagnostics_, markers_;
  PlatformEstimate::ConstPtr estimate_;
  visualization_msgs::MarkerArray::ConstPtr newest_markers_;
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> status_;  // by name
  bool always_finite_ = true;

 private:
  void onEstimate(const PlatformEstimate::ConstPtr& message) {
    estimate_ = message;
    always_finite_ = always_finite_ && positionOf(message->platform_pose).allFinite() &&
                     matrixFrom(message->compliance).allFinite() && matrixFrom(message->stiffness).allFinite() &&
                     matrixFrom(message->material_compliance).allFinite() && std::isfinite(message->numerical_error);
  }
  void onDiagnostics(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    for (const auto& status : message->status) status_[status.name] = status;
  }
  void onMarkers(const visualization_msgs::MarkerArray::ConstPtr& message) { newest_markers_ = message; }
};

TEST_F(ParallelNodeTest, EstimateEqualsCoreModel) {
  ASSERT_TRUE(driveUntil(leaning_, [&] { return solvedFor(leaning_); }));
  const ParallelSolution solution = expected(leaning_);
  EXPECT_TRUE(isAt(solution.X_BP, 1e-9));
  EXPECT_LT((matrixFrom(estimate_->compliance) - solution.compliance).norm(), 1e-6 * solution.compliance.norm());
  EXPECT_LT((matrixFrom(estimate_->material_compliance) - solution.material_compliance).norm(),
            1e-6 * solution.material_compliance.norm());
  EXPECT_LT((matrixFrom(estimate_->stiffness) * solution.compliance - Matrix6::Identity()).norm(), 1e-4);
  EXPECT_EQ(estimate_->status, PlatformEstimate::OK);
  EXPECT_EQ(estimate_->header.frame_id, "base");
  EXPECT_LE(estimate_->compliance_eigenvalues[0], estimate_->compliance_eigenvalues[2]);
  EXPECT_GT(estimate_->solve_time, 0.0);
}

TEST_F(ParallelNodeTest, BadLengthsKeepTheLastGoodEstimateMarkedStale) {
  struct Case {
    Lengths lengths;
    int status;
    std::string word;
  };
  const std::vector<Case> cases = {{{0.4, 0.4, kNaN, 0.4, 0.4, 0.4}, PlatformEstimate::INVALID_INPUT, "rod 3 is nan"},
                                   {{0.4, 0.4, 0.4}, PlatformEstimate::INVALID_INPUT, "must be 6"},
                                   {{0.4, -0.4, 0.4, 0.4, 0.4, 0.4}, PlatformEstimate::INVALID_INPUT, "rod 2 is -0.4"},
                                   {{0.1, 0.9, 0.1, 0.9, 0.1, 0.9}, PlatformEstimate::NOT_CONVERGED, "lengths"}};
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.word);
    ASSERT_TRUE(driveUntil(leaning_, [&] { return solvedFor(leaning_); }));
    ASSERT_TRUE(driveUntil(bad.lengths, [&] {
      return estimate_->stale && status_["parallel_node: Rod lengths"].level == 2 &&
             status_["parallel_node: Rod lengths"].message.find(bad.word) != std::string::npos;
    })) << status_["parallel_node: Rod lengths"].message;
    if (bad.status != PlatformEstimate::NOT_CONVERGED) {
      EXPECT_EQ(estimate_->status, bad.status);
    } else {
      EXPECT_GE(estimate_->status, bad.status);  // or only an unstable equilibrium
    }
    EXPECT_NE(estimate_->message.find(bad.word), std::string::npos) << estimate_->message;
    EXPECT_EQ(estimate_->length, leaning_) << "the values of the last good one";
  }
  EXPECT_TRUE(driveUntil(straight_, [&] { return solvedFor(straight_); })) << "must recover";
  ros::Publisher wrong_type = node_.advertise<std_msgs::String>("/arrays/lengths", 1);
  EXPECT_TRUE(publishUntil([&] { wrong_type.publish(std_msgs::String()); },
                           [&] { return status_["arrays_node: Rod lengths"].message.find("std_msgs/String") !=
                                        std::string::npos; }));
}

TEST_F(ParallelNodeTest, SilenceIsAnErrorAndMakesTheEstimateStale) {
  ASSERT_TRUE(driveUntil(leaning_, [&] {
    return solvedFor(leaning_) && status_["parallel_node: Rod lengths"].level == 0 &&
           status_["parallel_node: Solver"].level == 0;
  }));
  EXPECT_TRUE(waitFor([&] { return estimate_->stale && status_["parallel_node: Rod lengths"].level == 2; }));
  EXPECT_NE(estimate_->message.find("no rod lengths"), std::string::npos) << estimate_->message;
}

TEST_F(ParallelNodeTest, WrenchActsInItsFrameAndExpires) {
  Wrench wrench;
  wrench << 1.0, -0.5, 0.2, 0.0, 0.01, 0.0;
  const Pose free = expected(leaning_).X_BP, pushed = expected(leaning_, wrench).X_BP;
  ASSERT_TRUE(driveUntil(leaning_, [&] { return isAt(free); }));
  ASSERT_GT((free.p - pushed.p).norm(), 1e-4);
  const auto pushUntil = [&](const std::string& frame, auto condition) {
    return publishUntil(
        [&] {
          lengths_.publish(messageOf(leaning_));
          wrenches_.publish(toWrenchStamped(wrench, ros::Time::now(), frame));
        },
        condition);
  };
  EXPECT_TRUE(pushUntil("/base", [&] { return isAt(pushed); }));
  EXPECT_EQ(estimate_->wrench.force.x, 1.0);
  EXPECT_TRUE(driveUntil(leaning_, [&] { return isAt(free); })) << "after platform_wrench_timeout_s it counts as zero";
  EXPECT_TRUE(pushUntil("elsewhere", [&] {
    return status_["parallel_node: Solver"].message.find("unknown frame elsewhere") != std::string::npos;
  }));
  EXPECT_TRUE(isAt(free));
}

TEST_F(ParallelNodeTest, TransformAndMarkersShowTheEstimate) {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  const Pose X_BP = expected(leaning_).X_BP;
  ASSERT_TRUE(driveUntil(leaning_, [&] {
    if (!solvedFor(leaning_) || !newest_markers_ || newest_markers_->markers.size() < 2) return false;
    if (!buffer.canTransform("base", "platform", ros::Time(0))) return false;
    const auto& p = buffer.lookupTransform("base", "platform", ros::Time(0)).transform.translation;
    return (Vector3(p.x, p.y, p.z) - X_BP.p).norm() < 1e-7;
  }));
  std::map<std::string, int> count;
  for (const auto& marker : newest_markers_->markers) {
    ++count[marker.ns];
    EXPECT_EQ(marker.header.frame_id, "base");
  }
  EXPECT_EQ(count["rods"], 6);
  for (const char* name : {"base", "platform", "translation_ellipsoid", "rotation_ellipsoid", "text"})
    EXPECT_EQ(count[name], 1) << name;
}

TEST_F(ParallelNodeTest, TakesBareArraysInMillimetres) {
  PlatformEstimate::ConstPtr newest;
  const ros::Subscriber subscriber = node_.subscribe<PlatformEstimate>(
      "/arrays_node/estimate", 10, [&](const PlatformEstimate::ConstPtr& message) { newest = message; });
  ros::Publisher publisher = node_.advertise<std_msgs::Float64MultiArray>("/arrays/lengths", 10);
  std_msgs::Float64MultiArray message;
  for (double length : leaning_) message.data.push_back(1000.0 * length);
  const Pose X_BP = expected(leaning_).X_BP;
  ASSERT_TRUE(publishUntil([&] { publisher.publish(message); }, [&] {
    return newest && !newest->stale && (positionOf(newest->platform_pose) - X_BP.p).norm() < 1e-7;
  }));
  EXPECT_EQ(newest->header.frame_id, "arrays_base");
}

// The demo: the rig's inverse solution, through the node's forward one, lies on the circle that it was made for.
TEST_F(ParallelNodeTest, FollowsTheDemoRoundItsCircle) {
  std::set<int> quadrants;
  double worst = 0.0;
  const ros::Subscriber subscriber = node_.subscribe<PlatformEstimate>(
      "/moving/parallel_node/estimate", 10, [&](const PlatformEstimate::ConstPtr& message) {
        if (message->stale) return;
        const Vector3 p = positionOf(message->platform_pose);
        quadrants.insert(2 * (p.x() > 0.0) + (p.y() > 0.0));
        worst = std::max({worst, std::abs(std::hypot(p.x(), p.y()) - 0.1), std::abs(p.z() - 0.4)});
      });
  EXPECT_TRUE(waitFor([&] { return quadrants.size() == 4; }));
  EXPECT_LT(worst, 1e-7);
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "parallel_node_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
