// What stiffness_node answers, by services and by the handle at the tip, against the library. See questions.test.

#include <gtest/gtest.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/LU>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "live_stiffness/ComplianceAt.h"
#include "live_stiffness/DirectionalStiffness.h"
#include "live_stiffness/PredictDeflection.h"
#include "live_stiffness/analysis/directional_stiffness.h"
#include "live_stiffness/analysis/generalised_compliance.h"
#include "live_stiffness/analysis/holding_wrench.h"
#include "live_stiffness/rod/scene_file.h"
#include "support/driven_node.h"

namespace live_stiffness {
namespace {

using visualization_msgs::InteractiveMarkerFeedback;
using visualization_msgs::Marker;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kForcePerMetre = 20.0;  // tip_handle_force_n_per_m

// Warm against cold solves, each to the model's accuracy of 1e-9.
constexpr double kSame = 1e-7;

class QuestionsTest : public ::testing::Test {
 protected:
  QuestionsTest()
      : model_(loadSceneFile(parameter("scene_file")), ModelOptions()),
        workspace_(model_.makeWorkspace()),
        watched_("/stiffness_node"),
        pressures_(node_.advertise<ChamberPressures>("chamber_pressures", 10)),
        feedback_(node_.advertise<InteractiveMarkerFeedback>("/stiffness_node/tip_marker/feedback", 10)),
        markers_(node_.subscribe("/stiffness_node/markers", 10, &QuestionsTest::onMarkers, this)),
        handle_(node_.subscribe("/stiffness_node/tip_marker/update", 10, &QuestionsTest::onHandle, this)) {}

  void SetUp() override {
    solution_ = model_.solve(bent_, Wrench::Zero(), workspace_);
    ASSERT_TRUE(solution_.status.ok());
    ASSERT_TRUE(driveUntil([&] { return watched_.solvedFor(bent_) && feedback_.getNumSubscribers() > 0; }));
  }

  // The live estimate must be as if nobody had asked anything.
  void TearDown() override {
    const long before = watched_.estimates;
    ASSERT_TRUE(driveUntil([&] { return watched_.estimates > before && watched_.solvedFor(bent_); }));
    EXPECT_LT((positionOf(watched_.estimate->tip_pose) - solution_.X_BT.p).norm(), 1e-9);
    EXPECT_LT((matrixFrom(watched_.estimate->compliance) - solution_.compliance).norm(),
              kSame * solution_.compliance.norm());
    EXPECT_LT(watched_.estimate->iterations, 5) << "the live solver has lost its warm start";
    EXPECT_TRUE(watched_.always_finite);
  }

  template <class Condition>
  bool driveUntil(Condition condition) {
    return publishUntil([&] { pressures_.publish(toPressures(bent_, ros::Time::now())); }, condition);
  }

  template <class Service>
  typename Service::Response ask(const std::string& name, const typename Service::Request& request,
                                 const std::string& node = "/stiffness_node") {
    Service service;
    service.request = request;
    EXPECT_TRUE(ros::service::waitForService(node + "/" + name, ros::Duration(20.0)));
    EXPECT_TRUE(ros::service::call(node + "/" + name, service)) << name << " did not answer";
    return service.response;
  }

  // Refused with a message that names all the words, and without a number that is not finite.
  template <class Response>
  static void expectRefused(const Response& response, const std::vector<std::string>& words) {
    EXPECT_FALSE(response.success);
    for (const std::string& word : words)
      EXPECT_NE(response.message.find(word), std::string::npos) << word << " is not in: " << response.message;
  }

  static PredictDeflection::Request push(const Wrench& wrench, const std::string& frame = "base") {
    PredictDeflection::Request request;
    request.wrench = toWrenchStamped(wrench, ros::Time(), frame);
    return request;
  }

  // Sends an event of the handle, as rviz does.
  void send(uint8_t event, const Vector3& position, uint32_t menu_entry = 0) {
    InteractiveMarkerFeedback message;
    message.header.frame_id = "base";
    message.client_id = "questions_test";
    message.marker_name = "tip";
    message.event_type = event;
    message.menu_entry_id = menu_entry;
    message.pose = toPose({solution_.X_BT.R, position});
    feedback_.publish(message);
  }
  void drag(const Vector3& position) { send(InteractiveMarkerFeedback::POSE_UPDATE, position); }

  const Marker* marker(const std::string& name, int id = 0) const {
    const auto found = newest_.find({name, id});
    return found == newest_.end() || found->second.action != Marker::ADD ? nullptr : &found->second;
  }
  bool ghostSays(const std::string& word) const {
    return marker("ghost_text") && marker("ghost_text")->text.find(word) != std::string::npos;
  }
  Vector3 ghostTip() const {
    const auto& p = marker("ghost", 1)->pose.position;
    return {p.x, p.y, p.z};
  }

  const Pressures bent_ = pressuresOf({30e3, 30e3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 20e3, 20e3, 10e3, 10e3});
  const Wrench push_ = (Wrench() << 0.01, -0.005, 0.01, 1e-4, 0.0, 1e-4).finished();

  ros::NodeHandle node_;
  StiffnessModel model_;
  StiffnessWorkspace workspace_;
  StiffnessSolution solution_;
  Watched watched_;
  ros::Publisher pressures_, feedback_;
  ros::Subscriber markers_, handle_;
  std::map<std::pair<std::string, int>, Marker> newest_;
  Vector3 handle_position_ = Vector3::Zero();

 private:
  void onMarkers(const visualization_msgs::MarkerArray::ConstPtr& message) {
    for (const Marker& marker : message->markers) newest_[{marker.ns, marker.id}] = marker;
  }
  void onHandle(const visualization_msgs::InteractiveMarkerUpdate::ConstPtr& message) {
    for (const auto& pose : message->poses) handle_position_ = positionOf(pose.pose);
    for (const auto& marker : message->markers) handle_position_ = positionOf(marker.pose);
  }
};

TEST_F(QuestionsTest, TwoSegmentsOnTwelveChannelsAreShownInTwoColours) {
  ASSERT_EQ(watched_.estimate->pressure.size(), 12u);
  EXPECT_EQ(watched_.estimate->stretch.size(), 2u);
  ASSERT_TRUE(driveUntil([&] { return marker("ellipsoids", 9) && marker("eigenscrews", 11); }));
  using Shade = std::tuple<float, float, float>;
  std::set<Shade> of_first, of_second;
  for (int i = 0; i < 10; ++i) {
    const auto& color = marker("ellipsoids", i)->color;
    (i < 5 ? of_first : of_second).emplace(color.r, color.g, color.b);
    const Vector3 expected = model_.station(workspace_, i / 5, EstimatorOptions().fractions[i % 5]).X_BQ.p;
    EXPECT_LT((positionOf(marker("ellipsoids", i)->pose) - expected).norm(), kSame);
  }
  EXPECT_EQ(of_first.size(), 1u);
  EXPECT_EQ(of_second.size(), 1u);
  EXPECT_NE(of_first, of_second);
}

TEST_F(QuestionsTest, PredictDeflectionEqualsTheLibraryInBaseAndInTipAxes) {
  const DeflectionCheck expected = checkDeflection(model_, bent_, Wrench::Zero(), push_, workspace_);
  const Matrix3 R_TB = solution_.X_BT.R.transpose();
  Wrench in_tip_axes;
  in_tip_axes << R_TB * linear(push_), R_TB * angular(push_);
  for (const auto& request : {push(push_), push(push_, ""), push(in_tip_axes, "/tip")}) {
    const auto answer = ask<PredictDeflection>("predict_deflection", request);
    ASSERT_TRUE(answer.success) << answer.message;
    EXPECT_FALSE(answer.stale);
    EXPECT_EQ(answer.header.frame_id, "base");
    EXPECT_LT((positionOf(answer.exact) - expected.exact.p).norm(), kSame);
    EXPECT_LT((positionOf(answer.linear) - expected.predicted.linear.p).norm(), kSame);
    EXPECT_LT((positionOf(answer.exponential) - expected.predicted.exponential.p).norm(), kSame);
    EXPECT_NEAR(answer.exponential_position_error, expected.exponential_error.position, kSame);
    EXPECT_NEAR(answer.linear_rotation_error, expected.linear_error.rotation, 1e-5);
    EXPECT_GT(answer.exponential_position_error, 1e-6) << "the prediction is linear, the exact one is not";
  }
}

TEST_F(QuestionsTest, ComplianceAtEqualsTheLibrary) {
  solution_ = model_.solve(bent_, Wrench::Zero(), workspace_);
  for (const auto& [segment, fraction] : {std::make_pair(0, 0.5), std::make_pair(1, 0.0), std::make_pair(1, 1.0)}) {
    ComplianceAt::Request request;
    request.segment = segment;
    request.fraction = fraction;
    const auto answer = ask<ComplianceAt>("compliance_at", request);
    ASSERT_TRUE(answer.success) << answer.message;
    const GeneralisedCompliance tangent(model_, workspace_, Wrench::Zero(), {{segment, fraction}});
    const Station station = model_.station(workspace_, segment, fraction);
    EXPECT_LT((matrixFrom(answer.compliance) - tangent.between(0, 0)).norm(), kSame * solution_.compliance.norm());
    EXPECT_LT((matrixFrom(answer.material_compliance) - station.compliance).norm(),
              kSame * solution_.compliance.norm());
    EXPECT_LT((positionOf(answer.pose) - station.X_BQ.p).norm(), kSame);
    EXPECT_NEAR(answer.stretch, station.stretch, 1e-9);
  }
  ComplianceAt::Request tip;  // T is at the end of the last segment
  tip.segment = 1;
  tip.fraction = 1.0;
  EXPECT_LT((matrixFrom(ask<ComplianceAt>("compliance_at", tip).compliance) - solution_.compliance).norm(),
            kSame * solution_.compliance.norm());
}

TEST_F(QuestionsTest, DirectionalStiffnessEqualsTheLibraryInBaseAndInTipAxes) {
  const Vector3 direction(0.3, -2.0, 0.5), offset(0.01, 0.0, -0.02);
  const Matrix3& R = solution_.X_BT.R;
  const Matrix6 &C = solution_.compliance, K = solution_.compliance.inverse();
  for (const bool in_tip : {false, true}) {
    const Line line{in_tip ? R * offset : offset, in_tip ? R * direction : direction};
    DirectionalStiffness::Request request;
    request.frame_id = in_tip ? "tip" : "";
    request.direction = toVector(direction);
    request.offset = toVector(offset);
    const auto answer = ask<DirectionalStiffness>("directional_stiffness", request);
    ASSERT_TRUE(answer.success) << answer.message;
    EXPECT_NEAR(answer.free_along / freeStiffnessAlong(C, line), 1.0, 1e-6);
    EXPECT_NEAR(answer.constrained_along / constrainedStiffnessAlong(K, line), 1.0, 1e-6);
    EXPECT_NEAR(answer.free_about / freeStiffnessAbout(C, line), 1.0, 1e-6);
    EXPECT_NEAR(answer.constrained_about / constrainedStiffnessAbout(K, line), 1.0, 1e-6);
  }
}

TEST_F(QuestionsTest, BadRequestsAreRefusedWithValueAndLegalRange) {
  Wrench bad = push_;
  bad[1] = kNaN;
  expectRefused(ask<PredictDeflection>("predict_deflection", push(bad)), {"finite"});
  expectRefused(ask<PredictDeflection>("predict_deflection", push(push_, "camera")), {"camera", "base or tip"});
  for (double huge : {1e100, 1e300}) {
    const auto answer = ask<PredictDeflection>("predict_deflection", push(huge * push_));
    EXPECT_FALSE(answer.success) << huge;
    EXPECT_FALSE(answer.message.empty());
    EXPECT_TRUE(positionOf(answer.linear).allFinite() && positionOf(answer.exact).allFinite());
  }
  ComplianceAt::Request place;
  place.segment = 2;
  expectRefused(ask<ComplianceAt>("compliance_at", place), {"segment = 2", ">= 0 and <= 1"});
  place.segment = -1;
  place.fraction = kNaN;
  expectRefused(ask<ComplianceAt>("compliance_at", place), {"segment = -1", "fraction = nan", ">= 0 and <= 1"});
  DirectionalStiffness::Request line;
  expectRefused(ask<DirectionalStiffness>("directional_stiffness", line), {"direction = [0, 0, 0]", "not be zero"});
  line.direction.x = kNaN;
  expectRefused(ask<DirectionalStiffness>("directional_stiffness", line), {"direction", "nan", "finite"});
  line.direction.x = 1.0;
  line.offset.z = std::numeric_limits<double>::infinity();
  expectRefused(ask<DirectionalStiffness>("directional_stiffness", line), {"offset", "inf", "finite"});
  line.frame_id = "camera";
  expectRefused(ask<DirectionalStiffness>("directional_stiffness", line), {"camera", "base or tip"});
}

TEST_F(QuestionsTest, NothingIsAnsweredBeforeTheFirstEstimate) {
  expectRefused(ask<PredictDeflection>("predict_deflection", push(push_), "/idle_node"), {"nothing solved yet"});
  expectRefused(ask<ComplianceAt>("compliance_at", {}, "/idle_node"), {"nothing solved yet"});
  expectRefused(ask<DirectionalStiffness>("directional_stiffness", {}, "/idle_node"), {"nothing solved yet"});
  ros::Publisher to_none = node_.advertise<InteractiveMarkerFeedback>("/idle_node/tip_marker/feedback", 1);
  ASSERT_TRUE(waitFor([&] { return watched_.estimates > 0; }));
  EXPECT_EQ(to_none.getNumSubscribers(), 0u) << "tip_handle: false";
}

class TipHandleTest : public QuestionsTest {
 protected:
  static constexpr uint32_t kForce = 1, kWrench = 2, kApply = 3, kLetGo = 4;  // entries of the menu, from the top

  void select(uint32_t entry) { send(InteractiveMarkerFeedback::MENU_SELECT, solution_.X_BT.p, entry); }
  void SetUp() override {
    QuestionsTest::SetUp();
    select(kForce);
    ASSERT_TRUE(driveUntil([&] { return (handle_position_ - solution_.X_BT.p).norm() < 1e-6; }))
        << "the handle must follow the tip";
  }
  void TearDown() override {
    select(kLetGo);
    EXPECT_TRUE(driveUntil([&] { return !marker("ghost") && !marker("ghost_text"); }));
    QuestionsTest::TearDown();
  }
};

TEST_F(TipHandleTest, DraggedShowsTheForceThatHoldsTheTipThereAndTheRobotBent) {
  const Vector3 goal = solution_.X_BT.p + Vector3(0.004, -0.002, 0.002);
  const HoldingWrench expected = findHoldingWrench(model_, bent_, Wrench::Zero(), {goal, std::nullopt}, workspace_);
  ASSERT_TRUE(expected.reached);
  drag(goal);
  ASSERT_TRUE(driveUntil([&] { return marker("ghost") && marker("ghost_force"); })) << "no ghost";
  EXPECT_LT((ghostTip() - goal).norm(), 1e-7) << "at the handle";
  const auto& arrow = marker("ghost_force")->points;
  const Vector3 drawn(arrow[1].x - arrow[0].x, arrow[1].y - arrow[0].y, arrow[1].z - arrow[0].z);
  EXPECT_LT((kForcePerMetre * drawn - linear(expected.wrench)).norm(), 1e-4 * linear(expected.wrench).norm());
  char force[32];
  std::snprintf(force, sizeof force, "%.3g mN", 1e3 * linear(expected.wrench).norm());
  EXPECT_TRUE(ghostSays(force)) << marker("ghost_text")->text;
}

TEST_F(TipHandleTest, DraggedAsAPoseShowsTheWrenchThatHoldsIt) {
  select(kWrench);
  const Vector3 goal = solution_.X_BT.p + Vector3(0.0005, 0.0, 0.0);
  const HoldingWrench expected =
      findHoldingWrench(model_, bent_, Wrench::Zero(), {goal, solution_.X_BT.R}, workspace_);
  ASSERT_TRUE(expected.reached);
  char moment[32];
  std::snprintf(moment, sizeof moment, "%.3g mN m", 1e3 * angular(expected.wrench).norm());
  ASSERT_TRUE(publishUntil(
      [&] {
        pressures_.publish(toPressures(bent_, ros::Time::now()));
        drag(goal);
      },
      [&] { return marker("ghost") && ghostSays(moment); }));
  EXPECT_LT((ghostTip() - goal).norm(), 1e-7);
}

TEST_F(TipHandleTest, AppliedWrenchShowsTheExactDeflection) {
  select(kApply);
  const Vector3 way(0.0005, 0.0, 0.0005);
  Wrench wrench = Wrench::Zero();
  linear(wrench) = kForcePerMetre * way;
  const DeflectionCheck expected = checkDeflection(model_, bent_, Wrench::Zero(), wrench, workspace_);
  ASSERT_TRUE(expected.status.ok());
  ASSERT_TRUE(publishUntil(
      [&] {
        pressures_.publish(toPressures(bent_, ros::Time::now()));
        drag(solution_.X_BT.p + way);
      },
      [&] { return marker("ghost") && (ghostTip() - expected.exact.p).norm() < 1e-6; }));
  EXPECT_GT((expected.exact.p - solution_.X_BT.p).norm(), 1e-4);
}

TEST_F(TipHandleTest, RefusesSmoothlyWhereThereIsNoEquilibrium) {
  drag(Vector3(0.0, 0.0, -0.05));
  ASSERT_TRUE(driveUntil([&] { return ghostSays("no stable equilibrium"); }));
  EXPECT_FALSE(marker("ghost"));
  EXPECT_FALSE(marker("ghost_force"));
  drag(solution_.X_BT.p + Vector3(0.0, 0.002, 0.0));
  EXPECT_TRUE(driveUntil([&] { return marker("ghost") != nullptr; })) << "must recover";
}

TEST_F(TipHandleTest, IgnoresPosesThatAreNone) {
  drag(Vector3(kNaN, 0.0, 0.0));
  const Vector3 goal = solution_.X_BT.p + Vector3(0.002, 0.0, 0.0);
  drag(goal);
  ASSERT_TRUE(driveUntil([&] { return marker("ghost") != nullptr; }));
  EXPECT_LT((ghostTip() - goal).norm(), 1e-7);
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "questions_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
