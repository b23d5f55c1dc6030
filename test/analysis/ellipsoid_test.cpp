#include "live_stiffness/analysis/ellipsoid.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <random>

namespace live_stiffness {
namespace {

Matrix3 randomRotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().matrix();
}

// Distinct, repeated, tiny, huge and negative eigenvalues.
const Vector3 kEigenvalues[] = {{1.0, 2.0, 3.0},     {1.0, 1.0, 3.0},   {2.0, 2.0, 2.0},
                                {1e-12, 1e-3, 1e6},  {0.0, 0.0, 1.0},   {-0.5, 1.0, 2.0}};

TEST(Ellipsoid, ReproducesTheMatrixWithAscendingAxesAndRightHandedDirections) {
  std::mt19937 random(1);
  for (const Vector3& eigenvalues : kEigenvalues) {
    for (int i = 0; i < 50; ++i) {
      const Matrix3 R = randomRotation(random);
      const Matrix3 block = R * eigenvalues.asDiagonal() * R.transpose();
      const Ellipsoid ellipsoid = ellipsoidOf(block);
      const Matrix3& D = ellipsoid.directions;
      // A symmetric eigensolver is backward stable: a few rounding errors of the norm.
      const double rounding = 1e-14 * (1.0 + block.norm());
      EXPECT_LT((D * ellipsoid.half_axes.asDiagonal() * D.transpose() - block).norm(), rounding);
      EXPECT_LT((D.transpose() * D - Matrix3::Identity()).norm(), 1e-14);
      EXPECT_NEAR(D.determinant(), 1.0, 1e-14);
      EXPECT_LE(ellipsoid.half_axes[0], ellipsoid.half_axes[1]);
      EXPECT_LE(ellipsoid.half_axes[1], ellipsoid.half_axes[2]);
    }
  }
}

TEST(Ellipsoid, DirectionsDoNotFlipUnderASmallChange) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Matrix3 R = randomRotation(random);
    const Matrix3 block = R * Vector3(1.0, 2.0, 3.0).asDiagonal() * R.transpose();
    Matrix3 turned = block;
    turned(0, 1) += 1e-9;
    turned(1, 0) += 1e-9;
    const Matrix3 before = ellipsoidOf(block).directions, after = ellipsoidOf(turned).directions;
    // Unless a largest component ties with another, which a seeded draw does not hit, the axes move with the matrix.
    EXPECT_LT((after - before).norm(), 1e-7);
  }
}

// From the smallest to the largest numbers there are, and side by side.
TEST(Ellipsoid, OfAnySizeHasARotationOfFiniteAxes) {
  std::mt19937 random(3);
  for (const Vector3& eigenvalues :
       {Vector3(1e-300, 1.0, 1e300), Vector3(1e-300, 2e-300, 2e-300), Vector3(1e300, 1e300, 2e300),
        Vector3(1e-300, 1e-300, 1.0), Vector3(5e-324, 1e-310, 1e-308), Vector3(0.0, 0.0, 0.0)})
    for (int i = 0; i < 20; ++i) {
      const Matrix3 R = randomRotation(random);
      const Matrix3 block = R * eigenvalues.asDiagonal() * R.transpose();
      const Ellipsoid ellipsoid = ellipsoidOf(block);
      ASSERT_TRUE(ellipsoid.half_axes.allFinite() && ellipsoid.directions.allFinite()) << eigenvalues.transpose();
      EXPECT_LT((ellipsoid.directions.transpose() * ellipsoid.directions - Matrix3::Identity()).norm(), 1e-14);
      EXPECT_NEAR(ellipsoid.directions.determinant(), 1.0, 1e-14);
      EXPECT_LE(ellipsoid.half_axes[0], ellipsoid.half_axes[1]);
      EXPECT_LE(ellipsoid.half_axes[1], ellipsoid.half_axes[2]);
      // Relative to the largest, save where numbers are denormal and have no digits.
      if (eigenvalues[2] > 1e-305) {
        EXPECT_LT((ellipsoid.half_axes / eigenvalues[2] - eigenvalues / eigenvalues[2]).norm(), 1e-14);
      }
    }
}

TEST(Ellipsoid, OfBothBlocksOfASixBySixMatrix) {
  Matrix6 matrix = Matrix6::Zero();
  matrix.diagonal() << 3.0, 1.0, 2.0, 6.0, 5.0, 4.0;
  const EllipsoidPair pair = ellipsoidsOf(matrix);
  EXPECT_LT((pair.translation.half_axes - Vector3(1.0, 2.0, 3.0)).norm(), 1e-14);
  EXPECT_LT((pair.rotation.half_axes - Vector3(4.0, 5.0, 6.0)).norm(), 1e-14);
}

TEST(Ellipsoid, UsesTheSymmetricPartOfAnUnsymmetricBlock) {
  Matrix3 block = Vector3(1.0, 2.0, 3.0).asDiagonal();
  block(0, 1) = 0.1;
  block(1, 0) = -0.1;
  EXPECT_LT((ellipsoidOf(block).half_axes - Vector3(1.0, 2.0, 3.0)).norm(), 1e-14);
}

}  // namespace
}  // namespace live_stiffness
