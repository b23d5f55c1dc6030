#include "live_stiffness/analysis/ellipsoid.h"

#include <Eigen/Eigenvalues>

namespace live_stiffness {

Ellipsoid ellipsoidOf(const Matrix3& block) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(0.5 * block + 0.5 * block.transpose());
  Ellipsoid ellipsoid;
  ellipsoid.half_axes = solver.eigenvalues();
  ellipsoid.directions = solver.eigenvectors();
  for (int k = 0; k < 2; ++k) {
    Eigen::Index largest;
    ellipsoid.directions.col(k).cwiseAbs().maxCoeff(&largest);
    if (ellipsoid.directions(largest, k) < 0.0) ellipsoid.directions.col(k) *= -1.0;
  }
  ellipsoid.directions.col(2) = ellipsoid.directions.col(0).cross(ellipsoid.directions.col(1));
  return ellipsoid;
}

EllipsoidPair ellipsoidsOf(const Matrix6& matrix) {
  return {ellipsoidOf(matrix.topLeftCorner<3, 3>()), ellipsoidOf(matrix.bottomRightCorner<3, 3>())};
}

}  // namespace live_stiffness
