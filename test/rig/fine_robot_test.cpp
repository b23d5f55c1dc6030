// The rig's ground truth and the product's model are two programs for the same physics.

#include "rig/fine_robot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "live_stiffness/checks.h"
#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {
namespace {

// The model is asked for 1e-9, RK4 with 120 steps is better than that; ten times their sum leaves room for the random
// pressures near the end of the range. Any error of physics is a thousand times larger.
constexpr double kAgreement = 2e-8;  // of position over 0.1 m, and of the rotation matrix

Scene sceneFile(const std::string& name) { return loadSceneFile(SOURCE_DIR "/config/scenes/" + name + ".yaml"); }

// Compares at random pressures up to `highest` Pa and random tip wrenches up to `force` N and `moment` N m an axis.
void expectAgreement(const Scene& scene, double highest, double force, double moment) {
  ModelOptions options;
  options.stepping = Stepping::kContinuous;
  const StiffnessModel model(scene, options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  FineRobot robot(scene);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst_p = 0.0, worst_R = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    Pressures pressures(scene.chamberCount());
    for (double& p : pressures) p = highest * unit(random);
    Wrench wrench;
    for (int k = 0; k < 6; ++k) wrench[k] = (k < 3 ? force : moment) * (2.0 * unit(random) - 1.0);
    const StiffnessSolution solution = model.solve(pressures, wrench, workspace);
    const std::optional<Pose> X_BT = robot.solve(pressures, wrench);
    ASSERT_TRUE(solution.status.ok()) << model.describe(solution.status);
    ASSERT_TRUE(X_BT.has_value()) << trial;
    worst_p = std::max(worst_p, (X_BT->p - solution.X_BT.p).norm());
    worst_R = std::max(worst_R, (X_BT->R - solution.X_BT.R).norm());
  }
  EXPECT_LT(worst_p, 0.1 * kAgreement);
  EXPECT_LT(worst_R, kAgreement);
  std::printf("worst difference: position %.1e m, rotation %.1e\n", worst_p, worst_R);
}

TEST(FineRobot, AgreesWithTheModelForOneSegment) { expectAgreement(sceneFile("paper_one_segment"), 1.0e5, 0.0, 0.0); }

TEST(FineRobot, AgreesWithTheModelForOneSegmentUnderTipWrench) {
  expectAgreement(sceneFile("paper_one_segment"), 1.0e5, 0.2, 0.002);
}

TEST(FineRobot, AgreesWithTheModelForTwoSegments) {
  expectAgreement(sceneFile("paper_two_segments"), 0.8e5, 0.02, 5e-4);
}

// Far longer than what can be shot from the base.
TEST(FineRobot, AgreesWithTheModelForALongHangingArm) {
  Scene scene = sceneFile("paper_one_segment");
  scene.chain.assign(10, scene.chain.front());
  scene.gravity = 9.81 * Vector3::UnitZ();
  expectAgreement(scene, 0.6e5, 0.01, 1e-4);
}

TEST(FineRobot, AgreesWithTheModelForHeavyLinksAndAnOffsetTip) {
  Scene scene = sceneFile("stiff_flop_recorded");
  scene.gravity = Vector3(3.0, -2.0, 9.0);  // not along any axis
  scene.tip_mass = 0.005;
  scene.tip_offset = Vector3(0.004, -0.003, 0.006);
  expectAgreement(scene, 1.0e5, 0.1, 0.001);
}

TEST(FineRobot, AgreesWithTheClosedFormWithoutLoads) {
  Scene scene = sceneFile("paper_two_segments");
  scene.gravity.reset();
  expectAgreement(scene, 1.0e5, 0.0, 0.0);
}

TEST(FineRobot, DoesNotDependOnWhereItComesFrom) {
  const Scene scene = sceneFile("stiff_flop_recorded");
  FineRobot fresh(scene), used(scene);
  Pressures far = Pressures::Zero(6), here = Pressures::Zero(6);
  far[0] = far[1] = 1.1e5;
  here[4] = here[5] = 6e4;
  ASSERT_TRUE(used.solve(far));
  const std::optional<Pose> a = fresh.solve(here), b = used.solve(here);
  ASSERT_TRUE(a && b);
  EXPECT_LT((a->p - b->p).norm(), 1e-11);  // residual of 1e-10 of a radian, over 60 mm
}

TEST(FineRobot, HangsStraightByItsOwnStretchAtZeroPressure) {
  const Scene scene = sceneFile("stiff_flop_recorded");
  const std::optional<Pose> X_BT = FineRobot(scene).solve(Pressures::Zero(6));
  ASSERT_TRUE(X_BT);
  const Segment& segment = std::get<Segment>(scene.chain[0]);
  // Half its own weight and all of the link's, over EA.
  const double force = 9.81 * (0.5 * segment.mass() + 0.0135);
  const double stretch = force / (segment.section.youngs_modulus * segment.section.area(1.0));
  EXPECT_LT(X_BT->p.head<2>().norm(), 1e-12);
  EXPECT_NEAR(X_BT->p.z(), scene.length() + segment.length * stretch, 1e-12);
}

TEST(FineRobot, RefusesWhatItCannotSolve) {
  FineRobot robot(sceneFile("paper_one_segment"));
  EXPECT_FALSE(robot.solve(Pressures::Zero(5)));
  EXPECT_FALSE(robot.solve(Pressures::Constant(6, std::nan(""))));
  EXPECT_FALSE(robot.solve(Pressures::Constant(6, 3e5)));  // no solid area left
  EXPECT_FALSE(robot.inRange(Pressures::Constant(6, 3e5)));
  EXPECT_TRUE(robot.inRange(Pressures::Constant(6, 1e5)));
  EXPECT_TRUE(robot.solve(Pressures::Constant(6, 1e5)));  // and goes on afterwards
  EXPECT_THROW(FineRobot(Scene{}), ConfigurationError);
}

}  // namespace
}  // namespace live_stiffness
