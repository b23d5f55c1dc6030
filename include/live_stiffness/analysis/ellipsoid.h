#pragma once
// Compliance ellipsoids (20) of the 3x3 blocks of a compliance or stiffness matrix.

#include <Eigen/Geometry>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

// Image of the unit ball under a symmetric positive 3x3 matrix: half axes along orthonormal directions.
struct Ellipsoid {
  Vector3 half_axes = Vector3::Zero();     // ascending; for the translational block of C: m/N
  Matrix3 directions = Matrix3::Identity();  // columns, right-handed, so that it is a rotation (rviz needs one)
};

// Eigenvalues ascending and eigenvectors of the symmetric part of `block`. Sign of the axes: the largest component of
// the first two is positive and the third completes a right-handed basis, so that an ellipsoid does not flip between
// updates. Negative eigenvalues (an unstable equilibrium) are kept. block must be finite.
Ellipsoid ellipsoidOf(const Matrix3& block);

}  // namespace live_stiffness
