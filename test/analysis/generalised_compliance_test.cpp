#include "live_stiffness/analysis/generalised_compliance.h"

#include <gtest/gtest.h>

#include <iostream>

#include "live_stiffness/checks.h"
#include "rod/backbone.h"
#include "support/differences.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/point_loaded_rod.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

const Wrench kForce = (Wrench() << 0.02, -0.01, -0.01, 0, 0, 0).finished();
const Wrench kMoment = (Wrench() << 0.01, 0.02, -0.02, 1e-3, -2e-3, 1e-3).finished();
const std::vector<SectionPlace> kPlaces = {{0, 0.0}, {1, 0.31}, {0, 1.0}, {1, 0.0}, {}, {0, 0.62}, {0, 0.5}, {1, 1.0}};
constexpr int kBase = 0, kTip = 4;

struct Solved {
  StiffnessModel model;
  StiffnessWorkspace workspace;
  StiffnessSolution solution;

  Solved(const Scene& scene, const Pressures& pressures, const Wrench& wrench, double accuracy = 1e-12)
      : model(scene, accurateTo(accuracy)),
        workspace(model.makeWorkspace()),
        solution(model.solve(pressures, wrench, workspace)) {}
};

Pressures pressures(int chambers) {
  RandomSource random(7);
  return random.pairs(chambers, 0.0, 0.8e5);
}

TEST(GeneralisedCompliance, OfTheTipIsTheTangent) {
  for (const Scene& scene : {awkwardScene(), paperScene(2), weightlessPaperScene(2)})
    for (const Wrench& wrench : {Wrench(Wrench::Zero()), kForce, kMoment}) {
      Solved s(scene, pressures(12), wrench);
      ASSERT_TRUE(s.solution.status.ok());
      const GeneralisedCompliance C(s.model, s.workspace, wrench, kPlaces);
      ASSERT_TRUE(C.ok());
      EXPECT_LT(complianceError(C.between(kTip, kTip), s.solution.compliance, scene.length()), 1e-10);
      EXPECT_LT(poseError(C.pose(kTip), s.solution.X_BT, scene.length()), 1e-11);
      EXPECT_LT(poseError(C.pose(1), s.model.station(s.workspace, 1, 0.31).X_BQ, scene.length()), 1e-10);
    }
}

TEST(GeneralisedCompliance, IsReciprocalWithoutATipMoment) {
  for (const Wrench& wrench : {Wrench(Wrench::Zero()), kForce, kMoment}) {
    Solved s(awkwardScene(), pressures(12), wrench);
    ASSERT_TRUE(s.solution.status.ok());
    const GeneralisedCompliance C(s.model, s.workspace, wrench, kPlaces);
    const double length = s.model.scene().length(), size = scaledCompliance(s.solution.compliance, length).norm();
    double worst = 0.0;
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b)
        worst = std::max(worst, scaledCompliance(C.between(a, b) - C.between(b, a).transpose(), length).norm() / size);
    if (angular(wrench).isZero()) {
      EXPECT_LT(worst, 1e-10);
    } else {
      EXPECT_GT(worst, 1e-4);
    }
    EXPECT_LT(C.between(kTip, kBase).norm() + C.between(kBase, kTip).norm(), 1e-12 * size);  // the base is clamped
  }
}

// The product of transfers from base to tip would have no digit left.
TEST(GeneralisedCompliance, OfALongHangingArmIsTheTangentAndReciprocal) {
  const Scene one = paperScene(1);
  Scene scene = one;
  scene.gravity = 9.81 * Vector3::UnitZ();
  for (int i = 1; i < 32; ++i) scene.chain.insert(scene.chain.end(), one.chain.begin(), one.chain.end());
  Solved s(scene, pressures(6 * 32), kForce, 1e-10);
  ASSERT_TRUE(s.solution.status.ok());
  const GeneralisedCompliance C(s.model, s.workspace, kForce, {{}, {3, 0.4}, {20, 0.7}});
  ASSERT_TRUE(C.ok());
  const double length = scene.length();
  EXPECT_LT(complianceError(C.between(0, 0), s.solution.compliance, length), 1e-9);  // ten times the solve's accuracy
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < a; ++b)
      EXPECT_LT(complianceError(C.between(a, b), C.between(b, a).transpose(), length), 1e-9) << a << ", " << b;
}

TEST(GeneralisedCompliance, WithoutLoadIsTheMaterialComplianceUpToTheNearerPlace) {
  Solved s(weightlessPaperScene(2), pressures(12), Wrench::Zero());
  const GeneralisedCompliance C(s.model, s.workspace, Wrench::Zero(), kPlaces);
  ASSERT_TRUE(C.ok());
  const double length = s.model.scene().length();
  for (int a : {1, 2, 5, 6})
    for (int b : {1, 2, 5, 6}) {
      const auto before = [&](int x, int y) {
        return std::make_pair(kPlaces[x].segment, kPlaces[x].fraction) <=
               std::make_pair(kPlaces[y].segment, kPlaces[y].fraction);
      };
      const int nearer = before(a, b) ? a : b;
      const Station station = s.model.station(s.workspace, kPlaces[nearer].segment, kPlaces[nearer].fraction);
      const Matrix6 of_wrench = twistShift(C.pose(a).p - station.X_BQ.p).transpose();
      const Matrix6 expected = twistShift(C.pose(b).p - station.X_BQ.p) * station.compliance * of_wrench;
      EXPECT_LT(complianceError(C.between(a, b), expected, length), 1e-10) << a << ", " << b;
    }
}

// Twists of sections under a tip wrench, by solving anew and reading the stations: two segments, links and all.
TEST(GeneralisedCompliance, FromTheTipEqualsDifferences) {
  for (const Wrench& wrench : {kForce, kMoment}) {
    Solved s(awkwardScene(), pressures(12), wrench, 1e-13);
    ASSERT_TRUE(s.solution.status.ok());
    const GeneralisedCompliance C(s.model, s.workspace, wrench, kPlaces);
    for (int place : {1, 5, 2}) {
      const auto pose = [&](const Wrench& w) {
        StiffnessWorkspace workspace = s.model.makeWorkspace();
        s.model.solve(pressures(12), w, workspace);
        return s.model.station(workspace, kPlaces[place].segment, kPlaces[place].fraction).X_BQ;
      };
      const Matrix6 expected = complianceByDifferences(pose, wrench, C.between(kTip, kTip), s.model.scene().length());
      EXPECT_LT(complianceError(C.between(kTip, place), expected, s.model.scene().length()), 1e-6) << place;
    }
  }
}

// Wrench within the segment, by an integrator that has no part in the library, with a dead tip moment, too.
TEST(GeneralisedCompliance, BetweenAnySectionsEqualsDifferencesOfAnIndependentRod) {
  Scene scene = paperScene(1);
  scene.gravity = Vector3(2.5, -3.5, -8.0);
  double worst = 0.0;
  for (const Wrench& wrench : {kForce, kMoment}) {
    Solved s(scene, pressures(6), wrench);
    ASSERT_TRUE(s.solution.status.ok());
    const GeneralisedCompliance C(s.model, s.workspace, wrench, {{0, 0.3}, {0, 0.7}, {}});
    PointLoadedRod rod;
    rod.rest = s.workspace.backbone().rest[0];
    rod.length = rod.rest.stretch * segmentOf(scene, 0).length;
    rod.mass = segmentOf(scene, 0).mass();
    rod.tip_mass = scene.tip_mass;
    rod.loads = {*scene.gravity, wrench};
    constexpr int kSteps = 60, kStepOf[] = {18, 42, 60};  // RK4: 1e-8 in the shape, the same in its derivative
    for (int a : {0, 1})
      for (int b : {0, 1, 2}) {
        const auto pose = [&](const Wrench& w) { return rod.solve(kSteps, kStepOf[a], w)[kStepOf[b]]; };
        const Matrix6 expected = complianceByDifferences(pose, Wrench::Zero(), C.between(1, 1), scene.length());
        const double error = complianceError(C.between(a, b), expected, scene.length());
        EXPECT_LT(error, 1e-6) << a << " to " << b;
        worst = std::max(worst, error);
      }
  }
  std::cout << "largest difference " << worst << "\n";
}

TEST(GeneralisedCompliance, RefusesPlacesThatAreNotThere) {
  Solved s(paperScene(1), pressures(6), Wrench::Zero());
  for (const SectionPlace& bad : {SectionPlace{1, 0.5}, {-2, 0.5}, {0, 1.1}, {0, -0.1}, {0, std::nan("")}})
    EXPECT_THROW(GeneralisedCompliance(s.model, s.workspace, Wrench::Zero(), {bad}), ConfigurationError);
}

}  // namespace
}  // namespace live_stiffness
