#include "rod/statics.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <iostream>

#include "compliance/material_compliance.h"
#include "support/differences.h"
#include "support/errors.h"
#include "support/literal_rod.h"
#include "support/matrix_near.h"
#include "support/moment_balance.h"
#include "support/random_source.h"
#include "support/scenes.h"
#include "support/rest_state.h"

namespace live_stiffness {
namespace {

const Wrench kTipForce = (Wrench() << 0.08, -0.05, -0.06, 0.0, 0.0, 0.0).finished();
const Wrench kTipMoment = (Wrench() << 0.02, 0.03, -0.04, 3e-3, -4e-3, 2e-3).finished();

struct Case {
  const char* name;
  Scene scene;
};

std::vector<Case> scenes() {
  Scene oblique = paperScene(1);
  oblique.gravity = Vector3(4.0, -5.0, -7.0);
  return {{"one segment", paperScene(1)},
          {"one segment, oblique gravity", oblique},
          {"two segments", paperScene(2)},
          {"two segments, heavy links, tip mass off the axis, oblique gravity", awkwardScene()}};
}

Pressures pressuresFor(const Scene& scene) {
  RandomSource random(41);
  return random.pairs(scene.chamberCount(), 0.0, 1.0e5);
}

TEST(TangentCompliance, EqualsDifferencesOfTheResolvedTip) {
  for (const Case& c : scenes())
    for (const Wrench& wrench : {Wrench(Wrench::Zero()), kTipForce, kTipMoment}) {
      SCOPED_TRACE(::testing::Message() << c.name << ", wrench " << wrench.transpose());
      const StiffnessModel model(c.scene, accurateTo(1e-13));
      const Pressures pressures = pressuresFor(c.scene);
      const StiffnessSolution solution = solveCold(model, pressures, wrench);
      ASSERT_TRUE(solution.status.ok());
      const double length = c.scene.length();
      const auto tip = [&](const Wrench& w) { return solveCold(model, pressures, w).X_BT; };
      const Matrix6 differences = complianceByDifferences(tip, wrench, solution.compliance, length);
      const double error = complianceError(solution.compliance, differences, length);
      EXPECT_LT(error, 1e-6) << solution.compliance << "\ndifferences\n" << differences;
    }
}

TEST(TangentCompliance, IsSymmetricWhenNoTipMomentActs) {
  for (const Case& c : scenes())
    for (const Wrench& wrench : {Wrench(Wrench::Zero()), kTipForce}) {
      const StiffnessModel model(c.scene, accurateTo(1e-13));
      const StiffnessSolution solution = solveCold(model, pressuresFor(c.scene), wrench);
      ASSERT_TRUE(solution.status.ok()) << c.name;
      // Dead forces have a potential. What is left is the residual of 1e-12 rad and the truncation asked for.
      const Matrix6 C = scaledCompliance(solution.compliance, c.scene.length());
      EXPECT_TRUE(matrixNear(C, C.transpose(), 1e-11 * C.norm())) << c.name;
    }
}

TEST(TangentCompliance, IsNotSymmetricWhenADeadTipMomentActs) {
  for (const Case& c : scenes()) {
    const StiffnessModel model(c.scene, accurateTo(1e-13));
    const StiffnessSolution solution = solveCold(model, pressuresFor(c.scene), kTipMoment);
    ASSERT_TRUE(solution.status.ok()) << c.name;
    const Matrix6 C = scaledCompliance(solution.compliance, c.scene.length());
    EXPECT_GT((C - C.transpose()).norm(), 1e-3 * C.norm()) << c.name;
  }
}

TEST(Statics, MomentsBalanceAtTheBase) {
  for (const Case& c : scenes())
    for (const Wrench& wrench : {Wrench(Wrench::Zero()), kTipForce, kTipMoment}) {
      const StiffnessModel model(c.scene, accurateTo(1e-12));
      StiffnessWorkspace workspace = model.makeWorkspace();
      const StiffnessSolution solution = model.solve(pressuresFor(c.scene), wrench, workspace);
      ASSERT_TRUE(solution.status.ok()) << c.name;
      const Vector3 expected = momentOfLoads(model, workspace, solution.X_BT, wrench);
      // Gauss quadrature of order 10 over 12 parts is exact to rounding; the stations are accurate to 1e-12.
      EXPECT_TRUE(matrixNear(baseMoment(model, workspace, wrench), expected, 1e-9 * expected.norm())) << c.name;
    }
}

TEST(Statics, AgreesWithThePapersEquationsIntegratedLiterally) {
  Scene scene = paperScene(1);
  scene.gravity = Vector3(1.0, -2.0, -9.0);
  RandomSource random(42);
  for (bool loaded : {false, true})
    for (Stepping stepping : kSteppings) {
      SCOPED_TRACE(::testing::Message() << steppingName(stepping) << (loaded ? ", loaded" : ", pressure only"));
      const Pressures pressures = random.pairs(6, 0.0, stepping == Stepping::kLinear ? 1.5e5 : 1.2e5);
      DeadLoads loads;
      if (loaded) loads = {*scene.gravity, kTipForce};
      Scene set = scene;
      if (!loaded) set.gravity.reset();
      ModelOptions options = accurateTo(1e-13);
      options.stepping = stepping;
      const StiffnessModel model(set, options);
      StiffnessWorkspace workspace = model.makeWorkspace();
      const StiffnessSolution solution = model.solve(pressures, loads.tip, workspace);
      ASSERT_TRUE(solution.status.ok());
      const LiteralRod oracle(segmentOf(set, 0), set.tip_mass, loads, pressures, workspace.backbone().rest[0]);
      // RK4 of 600 steps: (1 rad / 600)^4 = 8e-12. Its shooting stops at 1e-12 of the actuation force, which is up to
      // 50 times the loads' own: 1e-10 in angle.
      const double error = poseError(solution.X_BT, oracle.solve(600), scene.length());
      EXPECT_LT(error, 1e-9);
      std::cout << steppingName(stepping) << (loaded ? ", loaded" : ", pressure only") << ": " << error << "\n";
    }
}

TEST(Statics, WithoutLoadIsTheUnloadedShape) {
  const Scene scene = paperScene(2);
  Backbone backbone(scene);
  const Pressures pressures = pressuresFor(scene);
  for (int k = 0; k < 2; ++k) {
    Scene copy = scene;
    backbone.rest[k] = restState(segmentOf(copy, k).section, pressures.segment(6 * k, 6), Stepping::kFixedStep, 7);
  }
  StaticsSolver solver(scene, 1e-12);
  ASSERT_TRUE(solver.solve(DeadLoads(), backbone).converged);
  EXPECT_TRUE(matrixNear(Vector3(backbone.elements[0].state.m_start), Vector3::Zero(), 0.0));
  Backbone closed(scene);
  closed.rest = backbone.rest;
  Matrix6 unused;
  solver.prepareUnloaded(closed);
  solveUnloaded(solver.chain(), 1e-12, closed, unused);
  EXPECT_LT(poseError(backbone.X_BT, closed.X_BT, scene.length()), 1e-12);  // the accuracy asked for
}

// Eight segments, 320 mm: hanging, a shot from the base would stray by exp(L sqrt(n c_bt)), here 1e5; standing, the chain
// topples over, to where it hangs.
TEST(Statics, EightSegmentsSolveUnderTheirOwnWeight) {
  Scene paper = paperScene(1);
  for (double gravity : {9.81, -9.81}) {
    Scene scene;
    scene.gravity = Vector3(0.0, 0.0, gravity);
    for (int k = 0; k < 8; ++k) scene.chain.push_back(segmentOf(paper, 0));
    scene.tip_mass = 0.005;
    const StiffnessModel model(scene, accurateTo(1e-9));
    RandomSource random(43);
    for (int i = 0; i < 20; ++i) {
      StiffnessWorkspace workspace = model.makeWorkspace();
      const StiffnessSolution solution = model.solve(random.pairs(48, 0.0, 0.5e5), Wrench::Zero(), workspace);
      ASSERT_TRUE(solution.status.ok()) << gravity << ": " << model.describe(solution.status);
      EXPECT_LT(solution.numerical_error, 1e-8);
      const Vector3 moment = momentOfLoads(model, workspace, solution.X_BT, Wrench::Zero());
      EXPECT_TRUE(matrixNear(baseMoment(model, workspace, Wrench::Zero()), moment, 1e-8));  // N m, of about 0.1
      EXPECT_EQ(solution.compliance.llt().info(), Eigen::Success);
    }
  }
}

// Standing, with all chambers at 1.5 bar, the paper's segment is past its buckling load: the straight shape balances, but
// nothing would hold it there, and it may lean in any direction.
TEST(Statics, ANeutralEquilibriumIsNotReturnedAsOk) {
  const StiffnessModel model(paperScene(1), ModelOptions());
  const StiffnessSolution solution = solveCold(model, Pressures::Constant(6, 1.5e5));
  EXPECT_EQ(solution.status.code, SolveCode::kUnstable);
  EXPECT_NE(model.describe(solution.status).find("no stable equilibrium"), std::string::npos);
}

// Newton's method from the unloaded shape ends on an unstable branch here.
TEST(Statics, AnUnstableEquilibriumGivesWayToTheStableOneThatTheRobotFallsTo) {
  const StiffnessModel model(paperScene(2), ModelOptions());
  Pressures pressures(12);
  pressures << 80386, 80386, 98216, 98216, 90725, 90725, 66227, 66227, 34248, 34248, 23915, 23915;
  const StiffnessSolution solution = solveCold(model, pressures);
  ASSERT_TRUE(solution.status.ok());
  EXPECT_EQ(solution.compliance.llt().info(), Eigen::Success);
  // The same branch as with slightly less weight.
  Scene lighter = paperScene(2);
  *lighter.gravity *= 0.95;
  const StiffnessModel lighter_model(lighter, ModelOptions());
  EXPECT_LT((solveCold(lighter_model, pressures).X_BT.p - solution.X_BT.p).norm(), 0.01);
}

// Reissner: a shearable, extensible column buckles at P (1 - P/EA + P/GA) = pi^2 EI / (4 L^2). Only the tangent sees
// it.
TEST(TangentCompliance, DivergesAtReissnersBucklingLoad) {
  Scene scene = weightlessPaperScene(1);
  scene.tip_mass = 0.0;
  const StiffnessModel model(scene, accurateTo(1e-12));
  const Segment& segment = segmentOf(scene, 0);
  const ComplianceDensity c = SectionMoments(segment.section).complianceDensity(1.0);
  const double GA = 1.0 / c.shear_elongation(0, 0), EA = 1.0 / c.shear_elongation(2, 2);
  const double euler = kPi * kPi / (4.0 * c.bending_torsion(0, 0) * segment.length * segment.length);
  double critical = euler;
  for (int i = 0; i < 100; ++i) critical = euler / (1.0 - critical / EA + critical / GA);
  const auto lateral = [&](double P) {
    return solveCold(model, Pressures::Zero(6), (Wrench() << 0, 0, -P, 0, 0, 0).finished()).compliance(0, 0);
  };
  // 1 / C goes through zero at the load: by the secant through two loads below it, extrapolated. Its curvature over
  // this distance leaves (1e-3)^2.
  const double a = 1.0 / lateral(0.998 * critical), b = 1.0 / lateral(0.999 * critical);
  EXPECT_NEAR(0.999 - b * 0.001 / (b - a), 1.0, 3e-6);
}

// Warm solves go on from the last change. That may save iterations; it must not show in the result, whatever the pressures
// do next.
TEST(WarmStart, IsAsAccurateAsAColdOneWhateverThePressuresDo) {
  const std::vector<Pressures> steps = {bars(0.40, {1, 1, 0.5, 0.5, 0, 0}), bars(0.41, {1, 1, 0.5, 0.5, 0, 0}),
                                        bars(0.42, {1, 1, 0.5, 0.5, 0, 0}), bars(0.43, {1, 1, 0.5, 0.5, 0, 0}),
                                        bars(0.42, {1, 1, 0.5, 0.5, 0, 0}), bars(0.42, {1, 1, 0.5, 0.5, 0, 0}),
                                        bars(0.60, {0, 1, 0.5, 0.5, 1, 0}), bars(0.61, {0, 1, 0.5, 0.5, 1, 0}),
                                        bars(0.0, {0, 0, 0, 0, 0, 0}),      bars(0.02, {0, 1, 0, 0, 0, 0})};
  for (const Vector3& gravity : {Vector3(0.0, 0.0, -9.81), Vector3(4.0, -5.0, -7.0)})
    for (double accuracy : {1e-3, 1e-6, 1e-9}) {
      Scene scene = paperScene(1);
      scene.gravity = gravity;
      const StiffnessModel model(scene, accurateTo(accuracy)), exact(scene, accurateTo(1e-13));
      StiffnessWorkspace workspace = model.makeWorkspace();
      for (size_t i = 0; i < steps.size(); ++i) {
        const StiffnessSolution warm = model.solve(steps[i], Wrench::Zero(), workspace);
        const StiffnessSolution expected = solveCold(exact, steps[i]);
        ASSERT_TRUE(warm.status.ok() && expected.status.ok());
        EXPECT_LT(complianceError(warm.compliance, expected.compliance, scene.length()), accuracy) << i;
        EXPECT_LT(complianceError(warm.material_compliance, expected.material_compliance, scene.length()), accuracy) << i;
        EXPECT_LT(poseError(warm.X_BT, expected.X_BT, scene.length()), accuracy) << i;
      }
    }
}

TEST(WarmStart, TakesFewerIterationsWhereThePressuresGoOnAsBefore) {
  const StiffnessModel model(paperScene(1), accurateTo(1e-9));
  const auto iterations = [&](bool steady) {
    StiffnessWorkspace workspace = model.makeWorkspace();
    int count = 0;
    double a = 0.5, b = 0.5;
    for (int i = 0; i < 10; ++i) {
      (steady || i % 2 == 0 ? a : b) += 0.01;  // the same step in one direction, or in two by turns
      const StiffnessSolution solution = model.solve(bars(1.0, {a, a, b, b, 0, 0}), Wrench::Zero(), workspace);
      EXPECT_TRUE(solution.status.ok());
      if (i >= 3) count += solution.iterations;
    }
    return count;
  };
  EXPECT_LT(iterations(true), iterations(false));
}

// A first solve that converges at once must not vouch for the next one.
TEST(WarmStart, FollowsAMomentThatGrowsFromNothing) {
  for (double accuracy : {1e-4, 1e-6, 1e-9}) {
    const StiffnessModel model(weightlessPaperScene(1), accurateTo(accuracy));
    StiffnessWorkspace workspace = model.makeWorkspace();
    const Pressures none = Pressures::Zero(6);
    for (double moment : {1e-8, 1e-8, 3e-3, 1e-8, 8e-3}) {
      Wrench wrench = Wrench::Zero();
      wrench[4] = moment;
      const StiffnessSolution warm = model.solve(none, wrench, workspace), cold = solveCold(model, none, wrench);
      ASSERT_TRUE(warm.status.ok() && cold.status.ok());
      EXPECT_LT(poseError(warm.X_BT, cold.X_BT, 0.04), 2.0 * accuracy) << moment << " at " << accuracy;
      EXPECT_LT(complianceError(warm.compliance, cold.compliance, 0.04), 2.0 * accuracy) << moment << " at " << accuracy;
    }
  }
}

TEST(WarmStart, ForgetsLoadsBeyondAllBounds) {
  for (double absurd : {1e100, 1e155, 1e300}) {
    const StiffnessModel model(paperScene(1), accurateTo(1e-9));
    StiffnessWorkspace workspace = model.makeWorkspace();
    const Pressures pressures = bars(0.5, {1, 1, 0, 0, 0, 0});
    const StiffnessSolution before = model.solve(pressures, kTipForce, workspace);
    ASSERT_TRUE(before.status.ok());
    EXPECT_FALSE(model.solve(pressures, absurd * Wrench::Unit(0), workspace).status.ok());
    const StiffnessSolution after = model.solve(pressures, kTipForce, workspace);
    ASSERT_TRUE(after.status.ok()) << absurd;
    EXPECT_LT(poseError(after.X_BT, before.X_BT, 0.04), 1e-8);
  }
}

}  // namespace
}  // namespace live_stiffness
