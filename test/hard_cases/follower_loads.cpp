// Follower loads. From the tip to the base they are an initial value problem; the dead-load solver reaches them by
// continuation, as the dead force that is the given one in the tip's axes, while that is stable as a dead load.

#include <Eigen/LU>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "hard_cases/hard_case.h"
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

// Newton's method on f = R(f) F e_x with dR/df from the tangent compliance, warm from load to load. Up to 12 kN: soon
// after, that shape is no longer stable under the same force as a dead one, and the solver rightly leaves it.
void tipLoadAsDeadLoad(HardOutcome& outcome) {
  const BareRod rod = simoRod();
  Backbone backbone = rod.backbone();
  StaticsSolver solver(rod.scene, 1e-12);
  DeadLoads loads;
  Matrix3 turn_of_force = Matrix3::Zero();
  for (double F = 250.0; F <= 12000.0; F += 250.0) {
    double miss = F;
    for (int i = 0; i < 12 && miss > 1e-10 * F; ++i) {
      const Vector3 follower = F * backbone.X_BT.R.col(0);
      const Matrix3 slope = Matrix3::Identity() + hat(follower) * turn_of_force;
      linear(loads.tip) += slope.partialPivLu().solve(follower - linear(loads.tip));
      outcome.solve(solver, loads, backbone);
      turn_of_force = solver.tangentCompliance().bottomLeftCorner<3, 3>();
      miss = (F * backbone.X_BT.R.col(0) - linear(loads.tip)).norm();
    }
    outcome.error(miss / F, 1e-10, "force in the tip's axes");
    const Vector3 expected = tipByMarchingFromTip(rod, F * Vector3::UnitX(), Vector3::Zero());
    outcome.error((backbone.X_BT.p - expected).norm() / kLength, 1e-8, "tip");
  }
}

}  // namespace

HardTheme followerLoads() {
  return {"follower_loads",
          {{"tip_load", "rod_benchmarks.json", tipLoad},
           {"uniform_load", "rod_benchmarks.json", uniformLoad},
           {"tip_load_as_dead_load", "marching from the tip", tipLoadAsDeadLoad}}};
}

}  // namespace live_stiffness
