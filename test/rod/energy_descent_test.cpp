#include "rod/energy_descent.h"

#include <gtest/gtest.h>

#include "rod/statics.h"
#include "support/bare_rod.h"
#include "support/elastica.h"
#include "support/matrix_near.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

struct Descent {
  EnergyDescent::End end;
  NodalRotations shape;

  // Of nodes at equal distances, by the trapezoidal rule, as the energy counts the work of a force.
  Vector3 tip() const {
    Vector3 sum = 0.5 * (shape.R.front().col(2) + shape.R.back().col(2));
    for (size_t i = 1; i + 1 < shape.R.size(); ++i) sum += shape.R[i].col(2);
    return sum / (shape.R.size() - 1.0);
  }
};

// From the shape without loads, in `intervals`; `runs` times, each from where the last one ended: it stops within second order
// of the minimum, so a further run polishes it.
Descent descend(const Scene& scene, const Backbone& backbone, const DeadLoads& loads, int intervals, int runs = 3) {
  const Chain chain(scene);
  Descent result{EnergyDescent::End::kNotConverged, NodalRotations(chain)};
  result.shape.resize(backbone, intervals);
  result.shape.takeUnloaded(chain, backbone);
  EnergyDescent descent(chain);
  for (int i = 0; i < runs; ++i) result.end = descent.run(loads, backbone.rest, i == 0 ? 0.25 : 1.0, result.shape);
  return result;
}

Descent descend(const BareRod& rod, const DeadLoads& loads, int intervals, int runs = 3) {
  return descend(rod.scene, rod.backbone(), loads, intervals, runs);
}

// P (sin(beta), 0, -cos(beta)), as of elasticaTip().
DeadLoads pushed(double P, double beta) {
  DeadLoads loads;
  linear(loads.tip) = P * Vector3(std::sin(beta), 0.0, -std::cos(beta));
  return loads;
}

constexpr double kEuler = kPi * kPi / 4.0;

// Lying (the load across), standing (little more than upright, below its load) and leaning (beyond it).
TEST(EnergyDescent, EndsInTheElasticaToSecondOrderInTheDistanceOfNodes) {
  for (const auto& [P, beta] : {std::pair(1.0, 0.5 * kPi), {20.0, 0.5 * kPi}, {0.9 * kEuler, 0.1}, {1.5 * kEuler, 1e-3},
                                {8.0 * kEuler, 0.01}, {20.0, 2.5}}) {
    const auto error = [&, P = P, beta = beta](int intervals) {
      const Descent descent = descend(BareRod::elastica(), pushed(P, beta), intervals);
      EXPECT_EQ(descent.end, EnergyDescent::End::kMinimum) << P << ", " << beta;
      return (descent.tip() - elasticaTip(P, beta)).norm();
    };
    const double coarse = error(48), fine = error(96);
    EXPECT_LT(fine, 2e-3) << P << ", " << beta;
    EXPECT_NEAR(coarse / fine, 4.0, 0.3) << P << ", " << beta;
  }
}

// What one run leaves is less than the nodes do, so that it is good enough for a guess.
TEST(EnergyDescent, StopsNearerToItsMinimumThanThatIsToTheRod) {
  for (const auto& [P, beta] : {std::pair(20.0, 0.5 * kPi), {1.5 * kEuler, 1e-3}, {8.0 * kEuler, 0.01}}) {
    const Vector3 once = descend(BareRod::elastica(), pushed(P, beta), 12, 1).tip();
    const Vector3 minimum = descend(BareRod::elastica(), pushed(P, beta), 12).tip();
    EXPECT_LT((once - minimum).norm(), (minimum - elasticaTip(P, beta)).norm()) << P << ", " << beta;
  }
}

// The straight column of N intervals has a buckling load of its own, exactly 4 N^2 sin^2(pi / (4 N)). Up to it upright is a
// minimum; beyond it, the column may lean in any direction.
TEST(EnergyDescent, IsNeutralForASymmetricColumnAboveItsLoad) {
  for (int N : {6, 24}) {
    const double critical = std::pow(2.0 * N * std::sin(kPi / (4.0 * N)), 2);
    for (double share : {0.5, 0.99, 0.9999}) {
      const Descent descent = descend(BareRod::elastica(), pushed(share * critical, 0.0), N);
      EXPECT_EQ(descent.end, EnergyDescent::End::kMinimum) << N << ", " << share;
      EXPECT_TRUE(matrixNear(descent.tip(), Vector3::UnitZ(), 1e-12)) << N << ", " << share;
    }
    for (double share : {1.01, 1.5, 8.0, 20.0}) {
      const Descent descent = descend(BareRod::elastica(), pushed(share * critical, 0.0), N, 1);
      EXPECT_EQ(descent.end, EnergyDescent::End::kNeutral) << N << ", " << share;
      EXPECT_LT(descent.tip().z(), 1.0 - 0.5 * std::min(0.01, share - 1.0)) << N << ", " << share;
    }
  }
}

TEST(EnergyDescent, LetsAnUnevenColumnFallToItsSoftSide) {
  for (int soft : {0, 1})
    for (double difference : {1.0, 0.01, 1e-4}) {
      BareRod rod = BareRod::elastica();
      rod.rest.c.bending_torsion(1 - soft, 1 - soft) = 1.0 / (1.0 + difference);
      const double P = 2.0 * kEuler;
      const Descent descent = descend(rod, pushed(P, 0.0), 96);
      EXPECT_EQ(descent.end, EnergyDescent::End::kMinimum) << soft << ", " << difference;
      const Vector3 expected = elasticaTip(P, 1e-9), tip = descent.tip();  // to either side
      // Within what 96 intervals leave.
      EXPECT_TRUE(matrixNear(Vector3(std::abs(tip[1 - soft]), tip[soft], tip.z()), expected, 1e-3)) << soft << ", " << difference;
    }
}

// Segments, links, weights, a tip off the axis, shear, elongation and a moment: what it minimises is the energy of the rod whose
// equilibrium the solver finds.
TEST(EnergyDescent, EndsInTheSolversEquilibriumToSecondOrder) {
  const Scene scene = awkwardScene();
  const StiffnessModel model(scene, accurateTo(1e-12));
  for (const Wrench& wrench : {Wrench(Wrench::Zero()), (Wrench() << 0.08, -0.05, -0.06, 3e-3, -4e-3, 2e-3).finished()}) {
    StiffnessWorkspace workspace = model.makeWorkspace();
    ASSERT_TRUE(model.solve(bars(0.5, {1, 1, 0.6, 0.2, 0, 0}).replicate(2, 1), wrench, workspace).status.ok());
    const Matrix3 expected = workspace.backbone().X_BT.R;
    Backbone rest = workspace.backbone();
    rest.resize({1, 1}, kMaxStages);
    const auto error = [&](int intervals) {
      const Descent descent = descend(scene, rest, {*scene.gravity, wrench}, intervals);
      EXPECT_EQ(descent.end, EnergyDescent::End::kMinimum);
      return (descent.shape.R.back() - expected).norm();
    };
    EXPECT_LT(error(96), 1e-4);
    EXPECT_NEAR(error(24) / error(48), 4.0, 0.3);
  }
}

TEST(EnergyDescent, OfLoadsThatAreNoNumberDoesNotConverge) {
  for (double load : {std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(descend(BareRod::elastica(), pushed(load, 1.0), 12, 1).end, EnergyDescent::End::kNotConverged);
}

}  // namespace
}  // namespace live_stiffness
