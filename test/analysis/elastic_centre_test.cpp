#include "live_stiffness/analysis/elastic_centre.h"

#include <gtest/gtest.h>

#include "live_stiffness/analysis/stiffness_matrix.h"
#include "support/frames.h"
#include "support/matrix_near.h"
#include "support/random_matrices.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

TEST(ElasticCentre, HasASymmetricCouplingThatItsAxesMakeDiagonal) {
  RandomSource random(1);
  for (int i = 0; i < 100; ++i) {
    const Matrix6 matrix = randomStiffness(random, 1.0, 100.0);
    for (const ElasticCentre& centre : {centreOfStiffness(matrix), centreOfCompliance(matrix)}) {
      ASSERT_TRUE(centre.exists);
      const Matrix3 coupling = centre.matrix.topRightCorner<3, 3>();
      EXPECT_TRUE(matrixNear(coupling, coupling.transpose(), 1e-13 * centre.matrix.norm()));
      const Matrix3 diagonal = centre.axes.transpose() * coupling * centre.axes;
      EXPECT_TRUE(matrixNear(diagonal, Matrix3(centre.coupling.asDiagonal()), 1e-13 * centre.matrix.norm()));
    }
  }
}

TEST(ElasticCentre, IsThePointInSpaceWhateverTheFrame) {
  RandomSource random(2);
  for (int i = 0; i < 100; ++i) {
    const Matrix6 K = randomStiffness(random, 1.0, 10.0), C = stiffnessOf(K).K;
    const Pose X = randomPose(random, 3.0);
    EXPECT_TRUE(matrixNear(X * centreOfStiffness(stiffnessInFrame(K, X)).offset, centreOfStiffness(K).offset, 1e-10));
    EXPECT_TRUE(matrixNear(X * centreOfCompliance(complianceInFrame(C, X)).offset, centreOfCompliance(C).offset, 1e-9));
  }
}

// Force at the middle of a straight uniform rod from a clamp to its end does not turn its end: both centres are there.
TEST(ElasticCentre, OfAStraightRodIsItsMiddle) {
  const StiffnessModel model(weightlessPaperScene(1), {});
  const StiffnessSolution solution = solveCold(model, Pressures::Zero(6));
  const Vector3 middle(0.0, 0.0, -0.5 * model.scene().length());
  const ElasticCentre of_C = centreOfCompliance(solution.compliance);
  const ElasticCentre of_K = centreOfStiffness(stiffnessOf(solution.compliance).K);
  EXPECT_TRUE(matrixNear(of_C.offset, middle, 1e-12));
  EXPECT_TRUE(matrixNear(of_K.offset, middle, 1e-12));
  EXPECT_TRUE(matrixNear(of_C.coupling, Vector3::Zero(), 1e-12));
}

TEST(ElasticCentre, OfABadMatrixDoesNotExist) {
  EXPECT_FALSE(centreOfStiffness(Matrix6::Zero()).exists);
  EXPECT_FALSE(centreOfCompliance(Matrix6::Constant(std::nan(""))).exists);
  EXPECT_FALSE(centreOfCompliance(-Matrix6::Identity()).exists);
}

}  // namespace
}  // namespace live_stiffness
