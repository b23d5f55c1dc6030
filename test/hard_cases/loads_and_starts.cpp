// Gravity of any size and direction, wrenches up to folding, and warm starts from anything.

#include <cmath>
#include <limits>

#include "hard_cases/hard_case.h"
#include "rig/fine_robot.h"
#include "rod/statics.h"
#include "support/bare_rod.h"
#include "support/elastica.h"
#include "support/errors.h"
#include "support/moment_balance.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

// Tip and base moment after a hundred warm steps of the load from zero: slow, and sure to be on the branch that the
// loads lead to.
Pose tipAlongLoads(const Scene& scene, const Backbone& solved) {
  Backbone backbone(scene);
  backbone.rest = solved.rest;
  StaticsSolver solver(scene, 1e-10);
  for (int i = 0; i <= 100; ++i) solver.solve({0.01 * i * *scene.gravity, Wrench::Zero()}, backbone);
  return backbone.X_BT;
}

// 0 to 20 g along the axes and all diagonals. Up to 5 g and not standing, there is one shape and RK4 finds it.
void gravity(HardOutcome& outcome) {
  for (int segments : {1, 2})
    for (double g : {0.0, 0.1, 1.0, 5.0, 20.0})
      for (int direction = 0; direction < 27; ++direction) {
        const Vector3 toward(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
        if (toward.isZero(0.0)) continue;
        Scene scene = paperScene(segments);
        scene.gravity = g * kStandardGravity * toward.normalized();
        const Pressures pressures = bars(0.8, {1, 1, 0.5, 0.2, 0, 0}).replicate(segments, 1);
        const StiffnessModel model(scene, continuousOptions(1e-10));
        StiffnessWorkspace workspace = model.makeWorkspace();
        const StiffnessSolution solution = outcome.solve(model, pressures, Wrench::Zero(), workspace);
        if (!solution.status.ok() || g == 0.0) continue;
        const Vector3 moment = momentOfLoads(model, workspace, solution.X_BT, Wrench::Zero());
        const double scale = DeadLoads{*scene.gravity, Wrench::Zero()}.baseForce(Chain(scene)).norm() * scene.length();
        outcome.error((baseMoment(model, workspace, Wrench::Zero()) - moment).norm() / scale, 1e-8, "moment balance");
        const Pose branch = tipAlongLoads(scene, workspace.backbone());
        outcome.error(poseError(solution.X_BT, branch, scene.length()), 1e-8, "pose on the branch of the loads");
        if (toward.z() < 0.0 || g > 5.0) continue;
        const std::optional<Pose> expected = FineRobot(scene).solve(pressures);
        outcome.expect(expected.has_value(), "the truth was not found");
        if (expected) outcome.error(poseError(solution.X_BT, *expected, scene.length()), 1e-7, "pose");
      }
}

// Up to 80 times the Euler load: bent double, within a twentieth of the length.
void folding(HardOutcome& outcome, std::vector<double> forces) {
  const BareRod rod = BareRod::elastica();
  for (double P : forces)
    for (double beta : {0.1, 0.5, 1.0, 0.5 * kPi, 2.5, 3.1}) {
      Backbone backbone = rod.backbone();
      StaticsSolver solver(rod.scene, 1e-12);
      DeadLoads loads;
      linear(loads.tip) = P * Vector3(std::sin(beta), 0.0, -std::cos(beta));
      const StaticsReport report = outcome.solve(solver, loads, backbone);
      if (report.converged && report.stable)
        outcome.error((backbone.X_BT.p - elasticaTip(P, beta)).norm(), 1e-9, "tip");
    }
}

// A tip moment winds the rod into an exact circle. A dead moment is stable up to half a turn: there its compliance
// ceases to be positive definite (it has no potential; Ziegler).
void coiling(HardOutcome& outcome) {
  const BareRod rod = BareRod::elastica();
  for (double angle : {1e-9, 0.1, 1.0, 2.0, 3.0, 3.14, 3.15, 4.0, 2.0 * kPi, 4.0 * kPi}) {
    Backbone backbone = rod.backbone();
    StaticsSolver solver(rod.scene, 1e-12);
    DeadLoads loads;
    loads.tip[4] = angle;
    const StaticsReport report = outcome.solve(solver, loads, backbone, angle < kPi);
    if (!report.stable) {
      outcome.error(std::abs(report.stable_share - kPi / angle), 2.5e-3, "share of the load that is stable");
      continue;
    }
    const Vector3 expected(2.0 * std::pow(std::sin(0.5 * angle), 2) / angle, 0.0, std::sin(angle) / angle);
    outcome.error((backbone.X_BT.p - expected).norm(), 1e-10, "tip");
  }
}

double difference(const StiffnessSolution& a, const StiffnessSolution& b, double length) {
  return std::max(poseError(a.X_BT, b.X_BT, length), complianceError(a.compliance, b.compliance, length));
}

// Leaning to one side beyond its load, the column is pushed to the other: it stays while it can, as a column does, and
// then goes over, to the elastica's other side.
void wrongBranch(HardOutcome& outcome) {
  const BareRod rod = BareRod::elastica();
  const double P = 1.5 * kPi * kPi / 4.0;
  for (double back : {0.001, 0.5}) {
    Backbone backbone = rod.backbone();
    StaticsSolver solver(rod.scene, 1e-12);
    const auto push = [&](double beta) {
      DeadLoads loads;
      linear(loads.tip) = P * Vector3(std::sin(beta), 0.0, -std::cos(beta));
      outcome.solve(solver, loads, backbone);
    };
    push(0.1);
    outcome.error((backbone.X_BT.p - elasticaTip(P, 0.1)).norm(), 1e-9, "tip before");
    push(-back);
    Vector3 expected = elasticaTip(P, back);
    expected.x() = -expected.x();
    // Hysteresis in the plane; but the column may swing around out of the plane, so it is not stable on the old side.
    outcome.error((backbone.X_BT.p - expected).norm(), 1e-6, "tip after");
  }
}

// A workspace that has solved anything else before, well or not, then gives what a fresh one gives.
void garbageBefore(HardOutcome& outcome, std::function<void(const StiffnessModel&, StiffnessWorkspace&, int)> spoil) {
  const Scene scene = paperScene(2);
  const StiffnessModel model(scene, accurateTo(1e-10));
  const Wrench wrench = (Wrench() << 0.01, -0.02, 0.0, 0.0, 5e-4, 0.0).finished();
  const Pressures pressures = bars(0.5, {1, 1, 0.6, 0.2, 0, 0}).replicate(2, 1);
  const StiffnessSolution expected = outcome.solveCold(model, pressures, wrench);
  StiffnessWorkspace workspace = model.makeWorkspace();
  for (int i = 0; i < 100; ++i) {
    spoil(model, workspace, i);
    const StiffnessSolution solution = outcome.solve(model, pressures, wrench, workspace);
    outcome.error(difference(solution, expected, scene.length()), 1e-9, "warm against cold");
  }
}

void fromWildSolves(HardOutcome& outcome) {
  RandomSource random(51);
  garbageBefore(outcome, [&](const StiffnessModel& model, StiffnessWorkspace& workspace, int i) {
    model.solve(random.pairs(12, -1e5, 1.5e5), std::pow(10.0, i % 4 - 2.0) * random.wrench(1.0, 0.05), workspace);
  });
}

void fromFailedSolves(HardOutcome& outcome) {
  RandomSource random(52);
  garbageBefore(outcome, [&](const StiffnessModel& model, StiffnessWorkspace& workspace, int i) {
    if (i % 2 == 0) model.solve(random.pairs(12, 2e5, 4e5), Wrench::Zero(), workspace);
    else model.solve(random.pairs(12, 0.0, 1e5), std::pow(10.0, i % 12) * random.wrench(1.0, 1.0), workspace);
  });
}

void fromNan(HardOutcome& outcome) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  garbageBefore(outcome, [&](const StiffnessModel& model, StiffnessWorkspace& workspace, int i) {
    Pressures pressures = Pressures::Constant(12, 4e4);
    Wrench wrench = Wrench::Zero();
    (i % 2 == 0 ? pressures[i % 12] : wrench[i % 6]) = i % 3 == 0 ? kNan : i % 3 == 1 ? kInfinity : -kInfinity;
    const StiffnessSolution solution = model.solve(pressures, wrench, workspace);
    outcome.expect(solution.status.code == SolveCode::kInvalidInput, "input that is not finite was taken");
  });
}

}  // namespace

HardTheme loadsAndStarts() {
  return {"loads_and_starts",
          {{"gravity_0_to_20_g", "RK4 of load path and rod; moment balance at the base", gravity},
           {"folding_tip_force", "elliptic integrals",
            [](HardOutcome& outcome) { folding(outcome, {1.0, 10.0, 50.0, 100.0, 200.0}); }},
           {"folding_beyond_the_bound", "elliptic integrals, or an honest failure",
            [](HardOutcome& outcome) {
              outcome.allowFailure();
              folding(outcome, {400.0, 1000.0, 1e6});
            }},
           {"coiling_tip_moment", "circle, stable up to half a turn", coiling},
           {"start_from_wrong_branch", "elliptic integrals", wrongBranch},
           {"start_from_wild_solves", "cold solve", fromWildSolves},
           {"start_from_failed_solves", "cold solve", fromFailedSolves},
           {"start_from_nan", "cold solve", fromNan}}};
}

}  // namespace live_stiffness
