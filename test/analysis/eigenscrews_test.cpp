#include "live_stiffness/analysis/eigenscrews.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "live_stiffness/analysis/stiffness_matrix.h"
#include "support/errors.h"
#include "support/frames.h"
#include "support/matrix_near.h"
#include "support/random_matrices.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

Matrix6 delta() {
  Matrix6 D = Matrix6::Zero();
  D.topRightCorner<3, 3>().setIdentity();
  D.bottomLeftCorner<3, 3>().setIdentity();
  return D;
}

// sum_i k_i w_i w_i^T
Matrix6 sumOf(const EigenscrewDecomposition& decomposition) {
  Matrix6 sum = Matrix6::Zero();
  for (const Eigenscrew& screw : decomposition.screws) {
    Vector6 w;
    w << screw.direction, screw.point.cross(screw.direction) + screw.pitch * screw.direction;
    sum += screw.coefficient * w * w.transpose();
  }
  return sum;
}

TEST(Eigenscrews, AreThoseOfKDeltaByAGeneralSolver) {
  RandomSource random(1);
  for (int i = 0; i < 100; ++i) {
    const Matrix6 K = randomStiffness(random, 1.0, 10.0);
    const EigenscrewDecomposition found = eigenscrewsOfStiffness(K);
    ASSERT_TRUE(found.definite);
    const Eigen::EigenSolver<Matrix6> general(K * delta(), false);
    Vector6 expected = general.eigenvalues().real(), actual;
    std::sort(expected.data(), expected.data() + 6);
    for (int k = 0; k < 6; ++k) actual[k] = found.screws[k].eigenvalue;
    std::sort(actual.data(), actual.data() + 6);
    EXPECT_TRUE(matrixNear(actual, expected, 1e-10));  // the general solver is the less accurate of the two
    for (const Eigenscrew& screw : found.screws) {
      Vector6 w;
      w << screw.direction, screw.point.cross(screw.direction) + screw.pitch * screw.direction;
      EXPECT_TRUE(matrixNear(K * delta() * w, screw.eigenvalue * w, 1e-11 * K.norm()));
      EXPECT_NEAR(screw.eigenvalue, 2.0 * screw.pitch * screw.coefficient, 1e-12 * K.norm());
      EXPECT_NEAR(screw.direction.norm(), 1.0, 1e-14);
      EXPECT_NEAR(screw.point.dot(screw.direction), 0.0, 1e-13);
    }
  }
}

TEST(Eigenscrews, AddUpToTheMatrixAgain) {
  RandomSource random(2);
  for (double spread : {1.0, 1e3, 1e6})
    for (double length : {1.0, 1e-3}) {
      const Matrix6 K = randomStiffness(random, length, spread);
      const EigenscrewDecomposition found = eigenscrewsOfStiffness(K);
      ASSERT_TRUE(found.definite);
      const Matrix6 error = withAngularScaled(sumOf(found) - K, 1.0 / length);
      EXPECT_LT(error.norm(), 1e-13 * withAngularScaled(K, 1.0 / length).norm()) << spread;
    }
}

TEST(Eigenscrews, HaveThreePositiveAndThreeNegativeEigenvaluesLargestFirst) {
  RandomSource random(3);
  for (int i = 0; i < 200; ++i) {
    const EigenscrewDecomposition found = eigenscrewsOfStiffness(randomStiffness(random, 0.1, 1e4));
    ASSERT_TRUE(found.definite);
    for (int k = 0; k < 6; ++k) EXPECT_EQ(found.screws[k].eigenvalue > 0.0, k < 3);
    for (int k : {0, 1, 3, 4})
      EXPECT_GE(std::abs(found.screws[k].eigenvalue), std::abs(found.screws[k + 1].eigenvalue));
  }
}

// Eigenvalues relative to the largest, since that is what rounding is relative to. Moving an origin by ten lengths
// rounds the rotational block at 100 times its size: 2e-14.
TEST(Eigenscrews, DoNotDependOnTheFrame) {
  RandomSource random(5);
  double worst_value = 0.0, worst_pitch = 0.0, worst_condition = 0.0;
  for (double spread : {1.0, 1e2, 1e4, 1e6})
    for (int i = 0; i < 100; ++i) {
      const Matrix6 K = randomStiffness(random, 0.05, spread);
      const Matrix6 moved = stiffnessInFrame(K, randomPose(random, 0.5));
      const EigenscrewDecomposition a = eigenscrewsOfStiffness(K), b = eigenscrewsOfStiffness(moved);
      ASSERT_TRUE(a.definite && b.definite);
      worst_condition = std::max(worst_condition, stiffnessOf(moved).condition);
      const double size = std::max(a.screws[0].eigenvalue, -a.screws[3].eigenvalue);
      for (int k = 0; k < 6; ++k) {
        worst_value = std::max(worst_value, std::abs(a.screws[k].eigenvalue - b.screws[k].eigenvalue) / size);
        // A pitch is as well defined as its eigenvalue stands apart from the others.
        if (spread == 1.0) worst_pitch = std::max(worst_pitch, std::abs(a.screws[k].pitch / b.screws[k].pitch - 1.0));
      }
    }
  EXPECT_LT(worst_value, 1e-10);
  EXPECT_LT(worst_pitch, 1e-10);
  EXPECT_GT(worst_condition, 1e8);
  std::cout << "eigenvalues " << worst_value << " and pitches " << worst_pitch << " apart; condition up to "
            << worst_condition << "\n";
}

// The same for the eigenvalues alone, from a compliance.
TEST(Eigenstiffnesses, OfAComplianceDoNotDependOnTheFrame) {
  RandomSource random(6);
  double worst = 0.0, worst_condition = 0.0;
  for (double spread : {1.0, 1e3, 1e6})
    for (int i = 0; i < 100; ++i) {
      const Matrix6 C = randomStiffness(random, 0.05, spread);  // any definite matrix may be a compliance
      const Matrix6 moved = complianceInFrame(C, randomPose(random, 0.5));
      const Eigenstiffnesses a = eigenstiffnessesOfCompliance(C), b = eigenstiffnessesOfCompliance(moved);
      ASSERT_TRUE(a.definite && b.definite);
      worst_condition = std::max(worst_condition, stiffnessOf(moved).condition);
      // Eigencompliances, relative to the largest.
      const double size = 1.0 / std::min(a.values[2], -a.values[5]);
      for (int k = 0; k < 6; ++k) worst = std::max(worst, std::abs(1.0 / a.values[k] - 1.0 / b.values[k]) / size);
    }
  EXPECT_LT(worst, 1e-10);
  EXPECT_GT(worst_condition, 1e8);
}

// Axes are lines in space: those of the moved matrix, moved back, are the same ones. Eigenvectors are as good as
// rounding (1e-13, see above) over the gap to the next eigenvalue, which for these draws is some 1e-3 of the largest.
TEST(Eigenscrews, AreTheSameLinesInSpaceWhateverTheFrame) {
  RandomSource random(7);
  constexpr double kLength = 0.05;
  double worst_angle = 0.0, worst_distance = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Matrix6 K = randomStiffness(random, kLength, 1e3);
    const Pose X_OF = randomPose(random, 0.5);
    const EigenscrewDecomposition a = eigenscrewsOfStiffness(K), b = eigenscrewsOfStiffness(stiffnessInFrame(K, X_OF));
    ASSERT_TRUE(a.definite && b.definite);
    for (int k = 0; k < 6; ++k) {
      const Eigenscrew& line = a.screws[k];
      const Vector3 direction = X_OF.R * b.screws[k].direction, point = X_OF.R * b.screws[k].point + X_OF.p;
      worst_angle = std::max(worst_angle, line.direction.cross(direction).norm());
      worst_distance = std::max(worst_distance, (point - line.point).cross(line.direction).norm() / kLength);
    }
  }
  EXPECT_LT(worst_angle, 1e-9);
  EXPECT_LT(worst_distance, 1e-9);
}

TEST(Eigenscrews, OfTheRobotDoNotDependOnTheFrame) {
  const StiffnessModel model(paperScene(2), accurateTo(1e-11));
  const StiffnessSolution solution = solveCold(model, bars(0.8, {1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0.5, 0.5}));
  ASSERT_TRUE(solution.status.ok());
  const Eigenstiffnesses tip = eigenstiffnessesOfCompliance(solution.compliance);
  const Eigenstiffnesses base = eigenstiffnessesOfCompliance(shiftCompliance(solution.compliance, -solution.X_BT.p));
  const Eigenstiffnesses body =
      eigenstiffnessesOfCompliance(complianceInBodyAxes(solution.compliance, solution.X_BT.R));
  ASSERT_TRUE(tip.definite && base.definite && body.definite);
  EXPECT_TRUE(matrixNear(base.values, tip.values, 1e-10 * tip.values.norm()));
  EXPECT_TRUE(matrixNear(body.values, tip.values, 1e-10 * tip.values.norm()));
  const EigenscrewDecomposition screws = eigenscrewsOfStiffness(stiffnessOf(solution.compliance).K);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(tip.values[k], screws.screws[k].eigenvalue, 1e-10 * tip.values.norm());
}

TEST(Eigenscrews, OfAnIndefiniteMatrixAreRefused) {
  Matrix6 K = Matrix6::Identity();
  K(4, 4) = -1.0;
  EXPECT_FALSE(eigenscrewsOfStiffness(K).definite);
  EXPECT_FALSE(eigenstiffnessesOfCompliance(K).definite);
  K(4, 4) = std::nan("");
  EXPECT_FALSE(eigenscrewsOfStiffness(K).definite);
  EXPECT_FALSE(eigenscrewsOfStiffness(Matrix6::Zero()).definite);
}

TEST(Eigenscrews, UnderADeadTipMomentAreOfTheSymmetricPartAndSaySo) {
  const StiffnessModel model(paperScene(1), accurateTo(1e-11));
  const Wrench moment = (Wrench() << 0, 0, 0, 3e-3, -4e-3, 2e-3).finished();
  const StiffnessSolution solution = solveCold(model, bars(0.5, {1, 1, 0, 0, 0, 0}), moment);
  ASSERT_TRUE(solution.status.ok());
  const Matrix6 K = stiffnessOf(solution.compliance).K;
  const EigenscrewDecomposition found = eigenscrewsOfStiffness(K);
  ASSERT_TRUE(found.definite);
  EXPECT_GT(found.asymmetry, 1e-4);
  const Matrix6 symmetric = 0.5 * (K + K.transpose());
  // Relative to entries whose units differ: rounding of N/m against N m.
  EXPECT_TRUE(matrixNear(sumOf(found), symmetric, 1e-12 * symmetric.norm()));
}

}  // namespace
}  // namespace live_stiffness
