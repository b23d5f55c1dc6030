#include "rod/conjugate_points.h"

#include <Eigen/LU>

namespace live_stiffness {
namespace {

// True if all eigenvalues of a matrix with three real eigenvalues are positive.
bool hasPositiveEigenvalues(const Matrix3& G) {
  const double minors = G(0, 0) * G(1, 1) - G(0, 1) * G(1, 0) + G(0, 0) * G(2, 2) - G(0, 2) * G(2, 0) +
                        G(1, 1) * G(2, 2) - G(1, 2) * G(2, 1);
  return G.trace() > 0.0 && minors > 0.0 && G.determinant() > 0.0;
}

}  // namespace

bool hasConjugatePoint(const Backbone& backbone) {
  const int end = backbone.passes->stages;
  Matrix3 before = Matrix3::Zero();
  for (const RodElement& element : backbone.elements) {
    Matrix3 phi;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) phi(i, k) = element.state.phi[k][i][end];
    if (!before.isZero(0.0) && !hasPositiveEigenvalues(phi * before.inverse())) return true;
    before = phi;
  }
  return false;
}

}  // namespace live_stiffness
