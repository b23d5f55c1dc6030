// Classical geometrically exact rods. The reference values are in the shared data folder (rod_benchmarks.json), which
// says for each block what it is and how it was computed; they are not copied here.

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "rod/statics.h"
#include "support/bare_rod.h"
#include "support/matrix_near.h"
#include "support/shared_data.h"

namespace live_stiffness {
namespace {

constexpr char kFile[] = "rod_benchmarks.json";
constexpr double kPromised = 1e-6;

Pose tipOf(const BareRod& rod, const DeadLoads& loads) {
  StaticsSolver solver(rod.scene, 1e-12);
  Backbone backbone = rod.backbone();
  EXPECT_TRUE(solver.solve(loads, backbone).converged);
  return backbone.X_BT;
}

// EI = L = 1, shear and elongation `ratio` times stiffer than bending.
BareRod stiffRod(double ratio) { return {1.0, 1.0, 1.0, ratio, ratio}; }

// The references are inextensible. Elongation and shear are of relative size P / GA = (P L^2 / EI) / ratio, so the
// error is of first order in 1 / ratio (see StiffShearAndElongationConverge...): at P L^2 / EI = 20 a ratio of 1e8
// leaves 1e-7. Infinite is allowed too, because only compliances enter, and exact.
constexpr double kInextensible = 1e8;

DeadLoads sideways(double force) {
  DeadLoads loads;
  loads.tip[0] = force;
  return loads;
}

TEST(RodBenchmarks, TipDeadLoadElastica) {
  const auto path = sharedDataFile(kFile);
  SKIP_WITHOUT(path, kFile);
  for (const YAML::Node& row : YAML::LoadFile(*path)["tip_dead_load_elastica"]["rows"])
    for (double ratio : {kInextensible, std::numeric_limits<double>::infinity()}) {
      const Pose X = tipOf(stiffRod(ratio), sideways(row["PL2_EI"].as<double>()));
      const double theta = std::atan2(X.R(0, 2), X.R(2, 2));
      const Vector3 expected(row["w_L"].as<double>(), row["u_L"].as<double>(), row["theta"].as<double>());
      EXPECT_TRUE(matrixNear(Vector3(X.p.x(), 1.0 - X.p.z(), theta), expected, kPromised)) << row["PL2_EI"];
    }
}

TEST(RodBenchmarks, StiffShearAndElongationConvergeToTheInextensibleRodInFirstOrder) {
  const DeadLoads loads = sideways(10.0);
  const Vector3 limit = tipOf(stiffRod(std::numeric_limits<double>::infinity()), loads).p;
  const auto error = [&](double ratio) { return (tipOf(stiffRod(ratio), loads).p - limit).norm(); };
  for (double ratio : {1e4, 1e5, 1e6, 1e7}) EXPECT_NEAR(error(ratio) / error(10.0 * ratio), 10.0, 0.1) << ratio;
  EXPECT_GT(error(1e6), kPromised);  // so a ratio of 1e6 would not do
  EXPECT_LT(error(kInextensible), 0.2 * kPromised);
}

TEST(RodBenchmarks, UniformDeadLoad) {
  const auto path = sharedDataFile(kFile);
  SKIP_WITHOUT(path, kFile);
  for (const YAML::Node& row : YAML::LoadFile(*path)["uniform_distributed_load"]["rows"]) {
    DeadLoads loads;
    loads.gravity.x() = row["qL3_EI"].as<double>();  // on 1 kg over 1 m
    const Vector3 p = tipOf(stiffRod(kInextensible), loads).p;
    const Vector3 expected(row["dead"][1].as<double>(), 0.0, row["dead"][0].as<double>());
    EXPECT_TRUE(matrixNear(p, expected, kPromised)) << row["qL3_EI"];
  }
}

// Data axes X, Y, Z in ours: start tangent Y is z, curving towards X is x, the load along Z is -y.
TEST(RodBenchmarks, BatheBolourchiBend) {
  const auto path = sharedDataFile(kFile);
  SKIP_WITHOUT(path, kFile);
  const double radius = 100.0, E = 1e7, G = E / 2.0;
  for (const YAML::Node& row : YAML::LoadFile(*path)["bathe_bolourchi_45deg"]["rows"]) {
    const std::string variant = row["variant"].as<std::string>();
    ASSERT_TRUE(variant == "kappa 5/6, GJ=G/6" || variant == "kappa 1, GJ=G/6") << variant;
    const double kappa = variant[6] == '5' ? 5.0 / 6.0 : 1.0;
    BareRod rod(radius * kPi / 4.0, E / 12.0, G / 6.0, kappa * G, E);
    rod.rest.curvature = Vector3(0.0, 1.0 / radius, 0.0);
    DeadLoads loads;
    loads.tip[1] = -row["F"].as<double>();
    const Vector3 p = tipOf(rod, loads).p;
    const Vector3 expected(row["tip"][0].as<double>(), row["tip"][1].as<double>(), row["tip"][2].as<double>());
    EXPECT_TRUE(matrixNear(Vector3(p.x(), p.z(), -p.y()), expected, kPromised * radius)) << variant << row["F"];
  }
}

}  // namespace
}  // namespace live_stiffness
