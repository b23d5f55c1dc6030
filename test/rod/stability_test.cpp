#include "rod/stability.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <vector>

#include "rod/backbone.h"
#include "support/bare_rod.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

double loadNumberOf(const BareRod& rod, const DeadLoads& loads) {
  return normalisedLoad(Chain(rod.scene), loads, rod.backbone());
}

TEST(LoadNumber, IsTheShareOfEulersLoad) {
  for (double share : {0.01, 0.5, 1.0, 4.0}) {
    DeadLoads loads;
    loads.tip[2] = -share * kPi * kPi / 4.0;
    const double number = loadNumberOf(BareRod::elastica(), loads);
    EXPECT_GT(number, share);
    EXPECT_LT(number, 1.0074 * share);
  }
}

TEST(LoadNumber, IsTheShareOfTheWeightThatAColumnCarries) {
  DeadLoads loads;
  loads.gravity.z() = -7.8373474;  // Greenhill 1881; of 1 kg
  const double number = loadNumberOf(BareRod::elastica(), loads);
  EXPECT_GT(number, 1.0);
  EXPECT_LT(number, 1.02);
}

// Torsion as soft as bending does not add to it; far softer it does: cables of no torsional stiffness kink.
TEST(LoadNumber, CountsSoftTorsion) {
  constexpr double kRigid = std::numeric_limits<double>::infinity();
  DeadLoads loads;
  loads.tip[0] = 1.0;
  const auto of = [&](double GJ) { return loadNumberOf(BareRod(1.0, 1.0, GJ, kRigid, kRigid), loads); };
  EXPECT_EQ(of(1.0), of(0.5));
  EXPECT_EQ(of(1.0), of(1e9));
  EXPECT_NEAR(of(1.0 / 3.0) / of(1.0), 1.5 / std::sqrt(2.0), 1e-12);
}

TEST(LoadNumber, OfNoLoadIsZeroAndOfNoNumberNone) {
  DeadLoads loads;
  EXPECT_EQ(loadNumberOf(BareRod::elastica(), loads), 0.0);
  loads.tip[1] = std::nan("");
  EXPECT_TRUE(std::isnan(loadNumberOf(BareRod::elastica(), loads)));
}

// Two segments, a link, a tip mass: against the matrix of the same operator on many points of the straight robot.
TEST(LoadNumber, BoundsTheEigenvaluesOfAChain) {
  constexpr int kPoints = 400;  // of each part
  Scene scene = awkwardScene();
  scene.tip_offset = Vector3(0.0, 0.003, 0.004);
  const StiffnessModel model(scene, ModelOptions());
  StiffnessWorkspace workspace = model.makeWorkspace();
  ASSERT_TRUE(model.solve(Pressures::Constant(12, 3e4), Wrench::Zero(), workspace).status.ok());
  const Backbone& backbone = workspace.backbone();
  const Chain chain(model.scene());
  DeadLoads loads;
  loads.gravity = Vector3(1.0, 0.0, -9.81);
  loads.tip << 0.05, 0.1, -0.2, 0.0, 0.0, 0.0;

  std::vector<double> softness, weight;
  Vector3 n = loads.baseForce(chain);
  double C = 0.0;
  for (const Chain::Part& part : chain.parts) {
    const bool is_rigid = part.segment < 0;
    const double length = is_rigid ? part.length : backbone.rest[part.segment].stretch * part.length;
    const double c =
        is_rigid ? 0.0 : backbone.rest[part.segment].c.bending_torsion.topLeftCorner<2, 2>().diagonal().maxCoeff();
    for (int i = 0; i < kPoints; ++i) {
      const double x = (i + 0.5) / kPoints;
      softness.push_back(C + x * length * c);
      weight.push_back((n - x * part.mass * loads.gravity).norm() * length / kPoints);
    }
    C += c * length;
    n -= part.mass * loads.gravity;
  }
  softness.push_back(C);
  weight.push_back(n.norm() * chain.tip_offset.norm());
  const Eigen::Index size = softness.size();
  Eigen::MatrixXd M(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j) M(i, j) = std::min(softness[i], softness[j]) * std::sqrt(weight[i] * weight[j]);
  const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues()[size - 1];
  const double number = normalisedLoad(chain, loads, backbone);
  EXPECT_GT(number, largest);
  EXPECT_LT(number, 1.02 * largest);
  EXPECT_NEAR(number / M.norm(), 1.0, 2e-3);
}

}  // namespace
}  // namespace live_stiffness
