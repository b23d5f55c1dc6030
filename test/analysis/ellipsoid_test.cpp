#include "live_stiffness/analysis/ellipsoid.h"

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

TEST(Ellipsoid, UsesTheSymmetricPartOfAnUnsymmetricBlock) {
  Matrix3 block = Vector3(1.0, 2.0, 3.0).asDiagonal();
  block(0, 1) = 0.1;
  block(1, 0) = -0.1;
  EXPECT_LT((ellipsoidOf(block).half_axes - Vector3(1.0, 2.0, 3.0)).norm(), 1e-14);
}

}  // namespace
}  // namespace live_stiffness
