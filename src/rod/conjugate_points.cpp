#include "rod/conjugate_points.h"

#include <Eigen/LU>

namespace live_stiffness {
// By Descartes' rule, which is exact for real eigenvalues.
int negativeEigenvalues(const Matrix3& G) {
  const double minors = G(0, 0) * G(1, 1) - G(0, 1) * G(1, 0) + G(0, 0) * G(2, 2) - G(0, 2) * G(2, 0) +
                        G(1, 1) * G(2, 2) - G(1, 2) * G(2, 1);
  const double signs[4] = {1.0, -G.trace(), minors, -G.determinant()};
  int positive = 0;
  for (int i = 0; i < 3; ++i) positive += signs[i] * signs[i + 1] < 0.0;
  return 3 - positive;
}

int conjugatePoints(const Backbone& backbone) {
  const int end = backbone.kernel->stages;
  int count = 0;
  Matrix3 before = Matrix3::Zero();
  for (const RodElement& element : backbone.elements) {
    Matrix3 phi;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) phi(i, k) = element.state.phi[k][i][end];
    if (!before.isZero(0.0)) count += negativeEigenvalues(phi * before.inverse());
    before = phi;
  }
  return count;
}

}  // namespace live_stiffness
