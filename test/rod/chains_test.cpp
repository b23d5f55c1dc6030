// Long chains and long rods: whatever hangs, leans or stands, the solver finds the minimum of the potential energy
// (energy_minimiser.h), says that there is none only where there is none, and does not care how a rod is cut into segments,
// how accurate it is asked to be, or where it starts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "live_stiffness/compliance/stiffness_model.h"
#include "support/energy_minimiser.h"
#include "support/errors.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

struct Posture {
  const char* name;
  Vector3 gravity;  // m/s^2, base axes
};
const Posture kHanging{"hanging", 9.81 * Vector3::UnitZ()};
const Posture kSideways{"sideways", 9.81 * Vector3::UnitX()};
const Posture kStanding{"standing", -9.81 * Vector3::UnitZ()};

constexpr double kHighest = 0.6e5;  // Pa

// `count` of the paper's segments without anything between, with its tip mass. length: of each, m.
Scene chainOf(int count, const Posture& posture, double length = 0.040) {
  Scene scene = paperScene(1);
  segmentOf(scene, 0).length = length;
  scene.chain.assign(count, scene.chain.front());
  scene.gravity = posture.gravity;
  return scene;
}

std::string nameOf(const Scene& scene, const char* of) {
  return std::string(of) + " " + std::to_string(scene.segmentCount()) + " segments of " +
         std::to_string(scene.length() / scene.segmentCount()) + " m";
}

// Of pose and tangent compliance, relative.
double errorOf(const StiffnessSolution& a, const StiffnessSolution& b, double length) {
  return std::max(poseError(a.X_BT, b.X_BT, length), complianceError(a.compliance, b.compliance, length));
}

// Intervals a segment. 4 mm each: extrapolated, that is good to 1e-6 for the paper's section wherever a robot is not near its
// brink.
int intervalsOf(const Scene& scene, double interval_m = 0.004) {
  return std::max(4, static_cast<int>(scene.length() / scene.segmentCount() / interval_m));
}

// The shape of the last solve, for the minimiser to start from.
NodeRotations shapeOf(const StiffnessModel& model, const StiffnessWorkspace& workspace, int intervals) {
  NodeRotations R(1, Matrix3::Identity());
  for (int k = 0; k < model.scene().segmentCount(); ++k)
    for (int i = 1; i <= intervals; ++i)
      R.push_back(model.station(workspace, k, static_cast<double>(i) / intervals).X_BQ.R);
  return R;
}

// A cold solve is ok, is where the energy is least, and knows how accurate it is.
void expectMinimum(const Scene& scene, const Pressures& pressures, const Wrench& force, const std::string& name,
                   Stepping stepping = Stepping::kFixedStep, double interval_m = 0.004) {
  SCOPED_TRACE(name);
  ModelOptions options = accurateTo(1e-9);
  options.stepping = stepping;
  const std::vector<RestState> rest = restStates(scene, pressures, options);
  const int intervals = intervalsOf(scene, interval_m);
  ExtrapolatedMinimum minimum = extrapolatedMinimum(scene, rest, force, intervals);
  ASSERT_TRUE(minimum.finest.isStable()) << minimum.finest.least_stiffness << ", residual " << minimum.finest.residual;

  const StiffnessModel model(scene, options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  const StiffnessSolution solution = model.solve(pressures, force, workspace);
  EXPECT_TRUE(solution.status.ok()) << model.describe(solution.status);
  if (solution.status.ok() && poseError(solution.X_BT, minimum.X_BT, scene.length()) > 0.01) {  // perhaps there are two
    minimum = extrapolatedMinimum(scene, rest, force, intervals, shapeOf(model, workspace, intervals));
    ASSERT_TRUE(minimum.finest.isStable());
  }
  // Ten times the accuracy; near the brink all that is small grows, in both.
  const double tolerance = 1e-8 / std::min(1.0, minimum.finest.least_stiffness);
  EXPECT_LT(std::max(minimum.pose_error, minimum.compliance_error), 1e2 * tolerance);  // else it says nothing
  if (!solution.status.ok()) return;
  // The next correction would be smaller by a factor of 16 at least.
  EXPECT_LT(poseError(solution.X_BT, minimum.X_BT, scene.length()), 0.1 * minimum.pose_error + tolerance);
  EXPECT_LT(complianceError(solution.compliance, minimum.compliance, scene.length()),
            0.1 * minimum.compliance_error + tolerance);
  EXPECT_LT(solution.numerical_error, 1e2 * tolerance);
}

TEST(Chains, RestWhereTheEnergyIsLeast) {
  RandomSource random(201);
  for (const Posture& posture : {kHanging, kSideways})
    for (int count : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32}) {
      const Scene scene = chainOf(count, posture);
      for (int i = 0; i < 2; ++i)
        expectMinimum(scene, random.pairs(6 * count, 0.0, kHighest), Wrench::Zero(), nameOf(scene, posture.name));
    }
}

TEST(Chains, RestWhereTheEnergyIsLeastUnderATipForce) {
  RandomSource random(202);
  for (int count : {2, 5, 10, 20, 32}) {
    const Scene scene = chainOf(count, kHanging);
    expectMinimum(scene, random.pairs(6 * count, 0.0, kHighest), random.wrench(0.1, 0.0), nameOf(scene, "pulled"));
  }
}

// The paper's segment as a rod of up to 2 m.
TEST(LongRods, RestWhereTheEnergyIsLeast) {
  RandomSource random(203);
  for (const Posture& posture : {kHanging, kSideways})
    for (double length : {0.2, 0.3, 0.5, 0.7, 1.0, 1.4, 2.0}) {
      const Scene scene = chainOf(1, posture, length);
      expectMinimum(scene, Pressures::Zero(6), Wrench::Zero(), nameOf(scene, posture.name));
      expectMinimum(scene, random.pairs(6, 0.0, kHighest), Wrench::Zero(), nameOf(scene, posture.name));
    }
}

// Soft and up to 1e4 times stiffer segments in turn, heavy links between, a tip off the axis. Half of them hang from
// obliquely above; the others reach out to the side.
TEST(MixedChains, RestWhereTheEnergyIsLeast) {
  RandomSource random(204);
  for (int count : {3, 6, 9, 14, 20, 28}) {
    Scene scene = chainOf(count, random.uniform(0.0, 1.0) < 0.5 ? kHanging : kSideways);
    *scene.gravity += random.vector(4.0);
    Pressures pressures = random.pairs(6 * count, 0.0, kHighest);
    std::vector<Body> chain;
    for (int k = 0; k < count; ++k) {
      const double ratio = k % 2 == 0 ? 1.0 : std::pow(10.0, random.uniform(0.0, 4.0));
      Segment& segment = segmentOf(scene, k);
      segment.section.youngs_modulus *= ratio;
      segment.section.shear_modulus *= ratio;
      pressures.segment(6 * k, 6) *= ratio;
      chain.push_back(segment);
      if (k % 3 == 0) chain.push_back(Link{random.uniform(0.005, 0.04), random.uniform(0.0, 0.02)});
    }
    scene.chain = chain;
    scene.tip_offset = random.vector(0.01);
    expectMinimum(scene, pressures, random.wrench(0.02, 0.0), nameOf(scene, "mixed"), Stepping::kContinuous);
  }
}

// Thin, long, of silicone rubber to nitinol: 1 mm x 1 m.
TEST(Catheters, RestWhereTheEnergyIsLeast) {
  constexpr double kInterval = 0.001;  // m; the softest bends at its base within 4 mm
  RandomSource random(205);
  for (const Posture& posture : {kHanging, kSideways})
    for (double modulus : {2e6, 2e8, 50e9}) {
      Scene scene = chainOf(1, posture, 1.0);
      scene.tip_mass = 1e-5;
      CrossSection& section = segmentOf(scene, 0).section;
      const double scale = 0.5e-3 / section.outer_radius, ratio = modulus / section.youngs_modulus;
      for (double* r : {&section.outer_radius, &section.lumen_radius, &section.chambers.radius,
                        &section.chambers.pitch_radius})
        *r *= scale;
      section.youngs_modulus *= ratio;
      section.shear_modulus *= ratio;
      // Curvature grows with pressure over modulus and radius; no more than 1e5 Pa, and no more than one turn or so.
      const Pressures pressures = random.pairs(6, 0.0, std::min(1e5, 0.02 * modulus));
      expectMinimum(scene, pressures, Wrench::Zero(), std::string("catheter ") + posture.name + " of " +
                    std::to_string(modulus) + " Pa", Stepping::kContinuous, kInterval);
    }
}

// From three segments on they stand only because they lean: their pressures differ from side to side.
TEST(StandingChains, RestWhereTheEnergyIsLeast) {
  RandomSource random(206);
  for (int count : {1, 2, 3, 4, 5}) {
    const Scene scene = chainOf(count, kStanding);
    for (int i = 0; i < 3; ++i)
      expectMinimum(scene, random.pairs(6 * count, 0.0, kHighest), Wrench::Zero(), nameOf(scene, "standing"));
  }
}

TEST(StandingChains, AreUnstableOnlyWhereTheEnergyHasNoMinimum) {
  RandomSource random(207);
  int stable = 0, neutral = 0;
  for (int count : {1, 2, 3, 4, 5, 6, 8, 16, 32})
    for (bool is_symmetric : {true, false}) {
      const Scene scene = chainOf(count, kStanding);
      SCOPED_TRACE(nameOf(scene, is_symmetric ? "symmetric" : "leaning"));
      const StiffnessModel model(scene, accurateTo(1e-9));
      const Pressures pressures =
          is_symmetric ? Pressures(Pressures::Constant(6 * count, 0.3e5)) : random.pairs(6 * count, 0.0, kHighest);
      const EnergyMinimum minimum =
          minimiseEnergy(scene, restStates(scene, pressures, model.options()), Wrench::Zero(), 16);
      ASSERT_TRUE(minimum.converged);
      const SolveStatus status = solveCold(model, pressures).status;
      if (minimum.isStable()) EXPECT_NE(status.code, SolveCode::kUnstable) << minimum.least_stiffness;
      else EXPECT_EQ(status.code, SolveCode::kUnstable) << minimum.least_stiffness;
      ++(minimum.isStable() ? stable : neutral);
    }
  EXPECT_GE(stable, 10);
  EXPECT_GE(neutral, 3);
}

// What a solve claims of itself, against a finer one.
TEST(Chains, AreAsAccurateAsTheySay) {
  RandomSource random(208);
  for (const Posture& posture : {kHanging, kSideways})
    for (int count : {2, 4, 8, 16, 32}) {
      const Scene scene = chainOf(count, posture);
      SCOPED_TRACE(nameOf(scene, posture.name));
      const StiffnessModel model(scene, accurateTo(1e-6)), exact(scene, accurateTo(1e-11));
      for (int i = 0; i < 4; ++i) {
        const Pressures pressures = random.pairs(6 * count, 0.0, kHighest);
        const StiffnessSolution a = solveCold(model, pressures), b = solveCold(exact, pressures);
        EXPECT_TRUE(a.status.ok() && b.status.ok()) << codeName(a.status.code) << ", " << codeName(b.status.code);
        if (!a.status.ok() || !b.status.ok()) continue;
        const double error = errorOf(a, b, scene.length());
        EXPECT_LE(error, 10.0 * a.numerical_error + 1e-10);  // the finer one is off by 1e-11, or by rounding
        EXPECT_LE(error, 3e-6);
      }
    }
}

// A uniform rod is the same rod whatever number of segments it is said to consist of.
TEST(UniformRods, MayBeCutIntoEqualSegments) {
  struct Load {
    const char* name;
    Posture posture;
    double length;  // of the rod, m
    Wrench wrench;
  };
  const Wrench none = Wrench::Zero(), force = (Wrench() << 0.03, -0.02, 0.01, 0.0, 0.0, 0.0).finished(),
               moment = (Wrench() << 0.0, 0.0, 0.0, 1e-3, -5e-4, 5e-4).finished();
  constexpr double kAsked = 1e-6;
  const Posture weightless{"weightless", Vector3::Zero()};
  for (const Load& load : {Load{"hanging", kHanging, 0.12, none}, Load{"hanging", kHanging, 0.6, none},
                           Load{"sideways", kSideways, 0.12, none}, Load{"sideways", kSideways, 0.6, none},
                           Load{"standing", kStanding, 0.12, none}, Load{"pulled", kHanging, 0.12, force},
                           Load{"pulled, weightless", weightless, 0.12, force},
                           Load{"pulled", kSideways, 0.6, force}, Load{"turned", kHanging, 0.12, moment},
                           Load{"turned, weightless", weightless, 0.12, moment},
                           Load{"turned", kHanging, 0.6, moment}, Load{"alone", weightless, 0.12, none}}) {
    const Pressures pressures = bars(0.5, {1, 1, 0.4, 0.4, 0.1, 0.1});
    StiffnessSolution whole;
    for (int count : {1, 2, 3, 5, 8}) {
      const Scene scene = chainOf(count, load.posture, load.length / count);
      SCOPED_TRACE(nameOf(scene, load.name));
      const StiffnessSolution solution =
          solveCold(StiffnessModel(scene, accurateTo(kAsked)), pressures.replicate(count, 1), load.wrench);
      EXPECT_TRUE(solution.status.ok()) << codeName(solution.status.code);
      if (count == 1) whole = solution;
      // Both are that accurate, and an error of the load grows in the compliance near the brink: another factor of 1.5.
      else EXPECT_LT(errorOf(solution, whole, scene.length()), 3.0 * kAsked);
    }
  }
}

TEST(CoarseAccuracy, IsEnoughToSolve) {
  const auto expectSolved = [](const Scene& scene, const Pressures& pressures, const char* of) {
    SCOPED_TRACE(nameOf(scene, of));
    const StiffnessSolution fine = solveCold(StiffnessModel(scene, accurateTo(1e-9)), pressures);
    EXPECT_TRUE(fine.status.ok()) << codeName(fine.status.code);
    for (double accuracy : {1e-3, 1e-5}) {
      const StiffnessSolution coarse = solveCold(StiffnessModel(scene, accurateTo(accuracy)), pressures);
      EXPECT_TRUE(coarse.status.ok()) << accuracy << ": " << codeName(coarse.status.code);
      if (!fine.status.ok() || !coarse.status.ok()) continue;
      EXPECT_LT(errorOf(coarse, fine, scene.length()), 10.0 * accuracy);  // as in accuracy_test
    }
  };
  RandomSource random(209);
  for (const Posture& posture : {kHanging, kSideways}) {
    for (int count : {1, 2, 3, 5, 8, 12, 20, 32})
      for (int i = 0; i < 2; ++i)
        expectSolved(chainOf(count, posture), random.pairs(6 * count, 0.0, kHighest), posture.name);
    for (double length : {0.2, 0.3, 0.5, 0.7, 1.0, 1.4, 2.0})
      for (int i = 0; i < 2; ++i)
        expectSolved(chainOf(1, posture, length), random.pairs(6, 0.0, kHighest), posture.name);
  }
}

TEST(Chains, EndWhereAColdStartEndsAfterAJumpOfAllPressures) {
  RandomSource random(210);
  for (const Posture& posture : {kHanging, kSideways})
    for (int count : {2, 5, 12, 32}) {
      const Scene scene = chainOf(count, posture);
      SCOPED_TRACE(nameOf(scene, posture.name));
      const StiffnessModel model(scene, accurateTo(1e-9));
      StiffnessWorkspace workspace = model.makeWorkspace();
      for (int i = 0; i < 5; ++i) {
        const Pressures pressures = random.pairs(6 * count, 0.0, kHighest);
        const StiffnessSolution warm = model.solve(pressures, Wrench::Zero(), workspace), cold = solveCold(model, pressures);
        EXPECT_TRUE(warm.status.ok()) << codeName(warm.status.code);
        EXPECT_TRUE(cold.status.ok()) << codeName(cold.status.code);
        if (!warm.status.ok() || !cold.status.ok()) continue;
        EXPECT_LT(errorOf(warm, cold, scene.length()), 2e-8);  // both are good to ten times the accuracy
      }
    }
}

}  // namespace
}  // namespace live_stiffness
