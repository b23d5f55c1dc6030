// Follower loads. From the tip to the base they are an initial value problem; from the base they are reached by
// continuation, as the dead force that is the given one in the tip's axes.

#include <Eigen/LU>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "hard_cases/hard_case.h"
#include "rod/shooting.h"
#include "support/bare_rod.h"
#include "support/shared_data.h"

namespace live_stiffness {
namespace {

constexpr double kLength = 100.0;

BareRod simoRod() { return {kLength, 3.5e7, 3.5e7, 1.61538e8, 4.2e8}; }

void tipLoad(HardOutcome& outcome) {
  const auto path = sharedDataFile("rod_benchmarks.json");
  if (!path) return;  // rod_benchmarks_test says that it is skipped
  for (const YAML::Node& row : YAML::LoadFile(*path)["follower_tip_load"]["rows"]) {
    const Vector3 p = tipByMarchingFromTip(simoRod(), row["F"].as<double>() * Vector3::UnitX(), Vector3::Zero());
    const Vector3 expected(row["v"].as<double>(), 0.0, kLength + row["u"].as<double>());
    outcome.error((p - expected).norm() / kLength, 1e-9, "tip");
  }
}

void uniformLoad(HardOutcome& outcome) {
  const auto path = sharedDataFile("rod_benchmarks.json");
  if (!path) return;
  for (const YAML::Node& row : YAML::LoadFile(*path)["uniform_distributed_load"]["rows"]) {
    const Vector3 load = row["qL3_EI"].as<double>() * Vector3::UnitX();
    const Vector3 p = tipByMarchingFromTip(BareRod::elastica(), Vector3::Zero(), load);
    const Vector3 expected(row["follower"][1].as<double>(), 0.0, row["follower"][0].as<double>());
    outcome.error((p - expected).norm(), 1e-6, "tip");  // the file's values are of a nearly inextensible rod
  }
}

// From load to load, by Newton's method on the base moment and the force in base axes: no moment may be left at the
// tip, and the force must be that of the tip's axes. A step of the load is taken along the solution's own derivative.
// Most of the way the shape would not be stable under the same force as a dead one; so this uses shots and columns, and
// not the solver, which would leave it.
void tipLoadByContinuation(HardOutcome& outcome) {
  constexpr double kStep = 250.0, kMost = 90000.0;
  const BareRod rod = simoRod();
  const Chain chain(rod.scene);
  Backbone backbone = rod.backbone();
  backbone.element_count[0] = 16;
  backbone.resize(kMaxStages);
  placeUnloaded(chain, backbone);
  DeadLoads loads;
  Vector3 m0 = Vector3::Zero(), residual;
  Vector6 by_load = Vector6::Zero();  // of [m0; force]
  for (double F = kStep; F <= kMost; F += kStep) {
    m0 += kStep * by_load.head<3>();
    linear(loads.tip) += kStep * by_load.tail<3>();
    double missed = 1.0;
    for (int i = 0; i < 8 && missed > 1e-12; ++i) {
      prepare(chain, loads, backbone);
      ElementSensitivities tip;
      outcome.expect(shoot(chain, loads, m0, true, backbone, residual), "a shot converges");
      outcome.expect(std::isfinite(tipSensitivities(chain, loads, i == 0, 1e-10, backbone, tip)), "columns converge");
      const Vector3 across = backbone.X_BT.R.col(0), force = F * across;
      Vector6 miss;
      miss << residual, linear(loads.tip) - force;
      Matrix6 slope;
      slope << sensitivityMatrix(tip.m), Matrix3::Zero(), Matrix3::Identity();
      slope.bottomRows<3>() += hat(force) * sensitivityMatrix(tip.phi);
      const auto lu = slope.partialPivLu();
      const Vector6 step = lu.solve(miss);
      m0 -= step.head<3>();
      linear(loads.tip) -= step.tail<3>();
      by_load = lu.solve((Vector6() << Vector3::Zero(), across).finished());
      missed = std::max(residual.norm() / (F * kLength), miss.tail<3>().norm() / F);
    }
    outcome.error(missed, 1e-12, "moment and force at the tip");
    const Vector3 expected = tipByMarchingFromTip(rod, F * Vector3::UnitX(), Vector3::Zero());
    outcome.error((backbone.X_BT.p - expected).norm() / kLength, 1e-10, "tip");
  }
}

}  // namespace

HardTheme followerLoads() {
  return {"follower_loads",
          {{"tip_load", "rod_benchmarks.json", tipLoad},
           {"uniform_load", "rod_benchmarks.json", uniformLoad},
           {"tip_load_by_continuation", "marching from the tip", tipLoadByContinuation}}};
}

}  // namespace live_stiffness
