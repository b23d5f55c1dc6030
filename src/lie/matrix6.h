#pragma once
// Solution, inverse and eigenvectors of 6x6 matrices, compiled once: each of these Eigen templates takes a compiler seconds.

#include "live_stiffness/conventions.h"

namespace live_stiffness {

// x of A x = b, and the inverse of A, by LU with partial pivoting. Of a singular matrix: not finite.
Vector6 solve(const Matrix6& A, const Vector6& b);
Matrix6 inverseOf(const Matrix6& A);

struct SymmetricEigen {
  Vector6 values;   // ascending
  Matrix6 vectors;  // column k, of length 1, belongs to values[k]
};

// A: symmetric; its lower triangle is read.
SymmetricEigen eigenOfSymmetric(const Matrix6& A);

}  // namespace live_stiffness
