// Near and beyond buckling: the tangent grows as it should, the straight branch is refused once it is unstable, and the
// stable one is found where there is one.

#include <cmath>

#include "hard_cases/hard_case.h"
#include "rod/statics.h"
#include "support/bare_rod.h"
#include "support/elastica.h"
#include "support/moment_balance.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

constexpr double kEuler = kPi * kPi / 4.0;  // of the elastica
// The branch search gives up when a step below 1e-3 of the loads would be next; steps shrink to 0.4 of their size.
constexpr double kShareSeen = 2.5e-3;

DeadLoads tipForce(double x, double z) {
  DeadLoads loads;
  loads.tip[0] = x;
  loads.tip[2] = z;
  return loads;
}

// Angle y(xi) of a heavy column, xi from the free end, under weight q and a sideways force at the tip, by power series:
// y'' + q xi y = -force, y'(0) = 0. Sums y and its integral over the length for given y(0).
struct HeavyColumn {
  double at_base = 0.0, integral = 0.0;

  HeavyColumn(double q, double angle_at_tip, double force) {
    double a[90] = {angle_at_tip, 0.0, -0.5 * force};
    for (int k = 0; k + 3 < 90; ++k) a[k + 3] = -q * a[k] / ((k + 3.0) * (k + 2.0));
    for (int k = 89; k >= 0; --k) {
      at_base += a[k];
      integral += a[k] / (k + 1.0);
    }
  }
  // Deflection of the tip by a unit sideways force: the free solution added so that the base does not turn.
  static double compliance(double q) {
    const HeavyColumn forced(q, 0.0, 1.0), free(q, 1.0, 0.0);
    return std::abs(forced.integral - forced.at_base / free.at_base * free.integral);
  }
  static double critical() {  // 7.8373...: the free solution does not turn the base
    double low = 7.0, high = 8.5;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (HeavyColumn(middle, 1.0, 0.0).at_base > 0.0 ? low : high) = middle;
    }
    return low;
  }
};

// The error of 1/C in terms of its value without load: how near the brink is, is known to that. Relative to C itself it
// is amplified as C is.
void tangentGrows(HardOutcome& outcome, double critical, std::function<DeadLoads(double)> loads,
                  std::function<double(double)> compliance) {
  const BareRod rod = BareRod::elastica();
  for (double share : {0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999, 0.9999, 0.999999}) {
    Backbone backbone = rod.backbone();
    StaticsSolver solver(rod.scene, 1e-12);
    outcome.solve(solver, loads(share * critical), backbone);
    const double expected = compliance(share * critical);
    for (int axis : {0, 1}) {
      const double actual = solver.tangentCompliance()(axis, axis);
      outcome.error(std::abs(1.0 / actual - 1.0 / expected) / 3.0, 1e-11, "stiffness");
    }
  }
}

void tipLoadTangent(HardOutcome& outcome) {
  tangentGrows(outcome, kEuler, [](double P) { return tipForce(0.0, -P); },
               [](double P) { return (std::tan(std::sqrt(P)) / std::sqrt(P) - 1.0) / P; });
}

void selfWeightTangent(HardOutcome& outcome) {
  outcome.error(std::abs(HeavyColumn::critical() / 7.8373474 - 1.0), 1e-8, "critical load number");
  tangentGrows(
      outcome, HeavyColumn::critical(),
      [](double q) {
        DeadLoads loads;
        loads.gravity.z() = -q;
        return loads;
      },
      HeavyColumn::compliance);
}

// Reissner: P (1 - P/EA + P/GA) = pi^2 EI / (4 L^2), of the paper's segment without pressure.
double reissnerLoad(const Segment& segment) {
  const ComplianceDensity c = SectionMoments(segment.section).complianceDensity(1.0);
  const double euler = kEuler / (c.bending_torsion(0, 0) * segment.length * segment.length);
  double load = euler;
  for (int i = 0; i < 100; ++i)
    load = euler / (1.0 + load * (c.shear_elongation(0, 0) - c.shear_elongation(2, 2)));
  return load;
}

void beyondReissner(HardOutcome& outcome) {
  Scene scene = weightlessPaperScene(1);
  scene.tip_mass = 0.0;
  const StiffnessModel model(scene, accurateTo(1e-9));
  const double critical = reissnerLoad(segmentOf(scene, 0));
  for (double share : {0.5, 0.9, 0.99, 0.999})
    outcome.solveCold(model, Pressures::Zero(6), -share * critical * Wrench::Unit(2));
  for (double share : {1.001, 1.05, 1.3, 2.0}) {
    const StiffnessSolution solution =
        outcome.solveCold(model, Pressures::Zero(6), -share * critical * Wrench::Unit(2), SolveCode::kUnstable);
    outcome.error(std::abs(solution.status.value - 1.0 / share), kShareSeen, "share of the load that is stable");
  }
}

void beyondSelfWeight(HardOutcome& outcome) {
  const BareRod rod = BareRod::elastica();
  for (double share : {1.001, 1.1, 2.0, 5.0}) {
    DeadLoads loads;
    loads.gravity.z() = -share * HeavyColumn::critical();
    Backbone backbone = rod.backbone();
    StaticsSolver solver(rod.scene, 1e-9);
    const StaticsReport report = outcome.solve(solver, loads, backbone, false);
    outcome.error(std::abs(report.stable_share - 1.0 / share), kShareSeen, "share of the load that is stable");
  }
}

// A push of beta P sideways decides where it leans. Because nothing prefers a direction but the push, turning the push
// turns the shape: across it, the compliance is the tip's distance over the push.
void expectElastica(HardOutcome& outcome, StaticsSolver& solver, Backbone& backbone, double P, double beta) {
  outcome.solve(solver, tipForce(P * std::sin(beta), -P * std::cos(beta)), backbone);
  const Vector3 expected = elasticaTip(P, beta);
  // A residual of 1e-12 rad is amplified as the compliance is, at the sharpest bend by beta^(-2/3).
  outcome.error((backbone.X_BT.p - expected).norm(), 1e-10 / std::pow(beta, 2.0 / 3.0), "tip");
  const double across = expected.x() / (P * std::sin(beta));
  outcome.error(std::abs(across / solver.tangentCompliance()(1, 1) - 1.0), 1e-10 / beta, "compliance across");
}

void buckledElastica(HardOutcome& outcome) {
  const BareRod rod = BareRod::elastica();
  for (double beta : {1e-1, 1e-2, 1e-4, 1e-6})
    for (double share : {0.5, 0.95, 1.0, 1.05, 1.5, 3.0, 6.0, 12.0}) {
      Backbone backbone = rod.backbone();
      StaticsSolver solver(rod.scene, 1e-12);
      expectElastica(outcome, solver, backbone, share * kEuler, beta);
    }
}

// Loaded and unloaded step by step, warm, through the critical load.
void warmThroughCritical(HardOutcome& outcome) {
  const BareRod rod = BareRod::elastica();
  for (double beta : {1e-2, 1e-4}) {
    Backbone backbone = rod.backbone();
    StaticsSolver solver(rod.scene, 1e-12);
    constexpr int kSteps = 150;
    for (int i = 1; i < 2 * kSteps; ++i) {
      const double share = 4.0 * std::min(i, 2 * kSteps - i) / kSteps;
      expectElastica(outcome, solver, backbone, share * kEuler, beta);
    }
  }
}

// The paper's segment stands symmetric at equal pressures: beyond its load it may lean anywhere, which is no finite
// compliance. The least difference of pressure decides, and gives a stable one.
void symmetricColumn(HardOutcome& outcome) {
  const Scene scene = paperScene(1);
  const StiffnessModel model(scene, accurateTo(1e-9));
  outcome.solveCold(model, Pressures::Constant(6, 1.3e5), Wrench::Zero());
  outcome.solveCold(model, Pressures::Constant(6, 1.5e5), Wrench::Zero(), SolveCode::kUnstable);
  StiffnessWorkspace workspace = model.makeWorkspace();
  const Pressures leaning = Pressures::Constant(6, 1.5e5) + bars(1e-3, {1, 1, 0, 0, 0, 0});
  const StiffnessSolution solution = outcome.solve(model, leaning, Wrench::Zero(), workspace);
  outcome.expect(solution.X_BT.p.x() < -1e-3, "does not lean away from the higher pressure");
  const Vector3 moment = momentOfLoads(model, workspace, solution.X_BT, Wrench::Zero());
  outcome.error((baseMoment(model, workspace, Wrench::Zero()) - moment).norm() / moment.norm(), 1e-8, "moment balance");
}

void standingChains(HardOutcome& outcome) {
  Scene paper = paperScene(1), scene;
  scene.gravity = Vector3(0.0, 0.0, -9.81);
  for (int k = 0; k < 8; ++k) scene.chain.push_back(segmentOf(paper, 0));
  scene.tip_mass = 0.005;
  const StiffnessModel model(scene, accurateTo(1e-9));
  RandomSource random(43);
  for (int i = 0; i < 40; ++i) {
    StiffnessWorkspace workspace = model.makeWorkspace();
    const StiffnessSolution solution = outcome.solve(model, random.pairs(48, 0.0, 0.5e5), Wrench::Zero(), workspace);
    const Vector3 moment = momentOfLoads(model, workspace, solution.X_BT, Wrench::Zero());
    // N m, over the weight times the length: a toppled chain's base moment passes through zero.
    const double scale = (8 * segmentOf(paper, 0).mass() + scene.tip_mass) * 9.81 * scene.length();
    outcome.error((baseMoment(model, workspace, Wrench::Zero()) - moment).norm() / scale, 1e-8, "moment balance");
  }
}

}  // namespace

HardTheme buckling() {
  return {"buckling",
          {{"tip_load_tangent", "tan(kL)/(kL) of the Euler column", tipLoadTangent},
           {"self_weight_tangent", "power series of the heavy column, critical at 7.8373", selfWeightTangent},
           {"beyond_reissner_load", "Reissner's critical load; status unstable", beyondReissner},
           {"beyond_self_weight", "critical load 7.8373; status unstable", beyondSelfWeight},
           {"buckled_elastica", "elliptic integrals", buckledElastica},
           {"warm_through_critical_load", "elliptic integrals", warmThroughCritical},
           {"symmetric_column", "status unstable, or leaning with moments in balance", symmetricColumn},
           {"standing_chains_of_8", "moment balance at the base", standingChains}}};
}

}  // namespace live_stiffness
