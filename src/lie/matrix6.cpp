#include "lie/matrix6.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace live_stiffness {

Vector6 solve(const Matrix6& A, const Vector6& b) { return A.partialPivLu().solve(b); }

Matrix6 inverseOf(const Matrix6& A) { return A.inverse(); }

SymmetricEigen eigenOfSymmetric(const Matrix6& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace live_stiffness
