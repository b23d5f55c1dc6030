#include "live_stiffness/analysis/stiffness_matrix.h"

#include <gtest/gtest.h>

#include "support/frames.h"
#include "support/matrix_near.h"
#include "support/random_matrices.h"

namespace live_stiffness {
namespace {

TEST(StiffnessOf, IsTheInverseWhateverTheUnits) {
  RandomSource random(1);
  // A rod of 1 m, of 1 um, of 1 km: as it stands the condition of C goes with the square of that.
  for (double length : {1.0, 1e-6, 1e3})
    for (double size : {1.0, 1e-200, 1e200}) {
      const Matrix6 C = size * randomStiffness(random, length, 1e3);
      const StiffnessMatrix result = stiffnessOf(C);
      ASSERT_TRUE(result.invertible) << length << ", " << size;
      const Matrix6 one = withAngularScaled(C, 1.0 / length) * withAngularScaled(result.K, length);
      EXPECT_TRUE(matrixNear(one, Matrix6::Identity(), 1e-15 * result.condition));
      EXPECT_LT(result.condition, 1e8);
    }
}

TEST(StiffnessOf, SaysThatASingularOrBadMatrixHasNoInverse) {
  Matrix6 rigid = Matrix6::Identity();
  rigid(2, 2) = 0.0;
  Matrix6 nearly = Matrix6::Identity();
  nearly(2, 2) = 1e-15;
  Matrix6 bad = Matrix6::Identity();
  bad(1, 4) = std::nan("");
  for (const Matrix6& C : {rigid, nearly, bad, Matrix6(Matrix6::Zero()), Matrix6(-Matrix6::Identity())}) {
    const StiffnessMatrix result = stiffnessOf(C);
    EXPECT_FALSE(result.invertible) << C;
    EXPECT_FALSE(std::isnan(result.condition));
    EXPECT_TRUE(matrixNear(result.K, Matrix6::Zero(), 0.0));
  }
}

TEST(Frames, OfStiffnessAndComplianceStayInversesOfOneAnother) {
  RandomSource random(2);
  for (int i = 0; i < 50; ++i) {
    const Matrix6 C = randomStiffness(random, 1.0, 10.0);
    const Pose X = randomPose(random, 2.0);
    const Matrix6 product = complianceInFrame(C, X) * stiffnessInFrame(stiffnessOf(C).K, X);
    EXPECT_TRUE(matrixNear(product, Matrix6::Identity(), 1e-9));
    // (18) as printed, with the adjoint of wrenches.
    const Matrix6 Ad = wrenchAdjoint(X);
    EXPECT_TRUE(matrixNear(complianceInFrame(C, X), Ad.transpose() * C * Ad, 1e-12));
  }
}

TEST(Asymmetry, IsZeroForASymmetricMatrixAndDoesNotDependOnUnits) {
  RandomSource random(3);
  Matrix6 C = randomStiffness(random, 1.0, 10.0);
  EXPECT_LT(asymmetryOf(C), 1e-15);
  C(0, 5) += 0.1;
  const double asymmetry = asymmetryOf(C);
  EXPECT_GT(asymmetry, 1e-3);
  EXPECT_NEAR(asymmetryOf(withAngularScaled(C, 1e-5)), asymmetry, 1e-14);
}

}  // namespace
}  // namespace live_stiffness
