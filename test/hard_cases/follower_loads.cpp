// Follower loads through the dead-load solver by continuation: the dead force that is a given one in the tip's axes.

#include <yaml-cpp/yaml.h>

#include <cmath>

#include "hard_cases/hard_case.h"
#include "support/bare_rod.h"
#include "support/shared_data.h"

namespace live_stiffness {
namespace {

// Newton's method on f = R(f) F e_x with dR/df from the tangent compliance; warm from load to load.
void followerTipLoad(HardOutcome& outcome) {
  const auto path = sharedDataFile("rod_benchmarks.json");
  if (!path) return;  // rod_benchmarks_test reports it as skipped
  constexpr double kLength = 100.0;
  const BareRod rod(kLength, 3.5e7, 3.5e7, 1.61538e8, 4.2e8);
  Backbone backbone = rod.backbone();
  StaticsSolver solver(rod.scene, 1e-12);
  DeadLoads loads;
  double F = 0.0;
  backbone.X_BT = Pose();
  Matrix3 turn_of_force = Matrix3::Zero();
  for (const YAML::Node& row : YAML::LoadFile(*path)["follower_tip_load"]["rows"]) {
    const double target = row["F"].as<double>();
    while (F < target) {
      F = std::min(target, F + 250.0);
      bool settled = false;
      for (int i = 0; i < 12 && !settled; ++i) {
        const Vector3 follower = F * backbone.X_BT.R.col(0);
        const Vector3 miss = follower - linear(loads.tip);
        settled = i > 0 && miss.norm() < 1e-10 * F;
        if (settled) break;
        const Matrix3 slope = Matrix3::Identity() + hat(follower) * turn_of_force;
        linear(loads.tip) += slope.partialPivLu().solve(miss);
        outcome.solve(solver, loads, backbone);
        turn_of_force = solver.tangentCompliance().bottomLeftCorner<3, 3>();
      }
      outcome.expect(settled, "follower force not met at " + std::to_string(F));
      if (!outcome.ok()) return;
    }
    const Vector3 expected(row["v"].as<double>(), 0.0, kLength + row["u"].as<double>());
    outcome.error((backbone.X_BT.p - expected).norm() / kLength, 1e-8, "tip at F = " + row["F"].as<std::string>());
  }
}

}  // namespace

HardTheme followerLoads() {
  return {"follower_loads", {{"follower_tip_load", "rod_benchmarks.json", followerTipLoad}}};
}

}  // namespace live_stiffness
