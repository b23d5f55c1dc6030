#pragma once
// Compliance and stiffness ellipsoids (20) of the 3x3 blocks of a compliance or stiffness matrix.

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
// updates. Negative eigenvalues (an unstable equilibrium) are kept. Entries may have any size from 1e-300 to 1e300; the
// error of an eigenvalue is rounding, relative to the largest one. Equal eigenvalues have arbitrary orthonormal
// directions. block must be finite.
Ellipsoid ellipsoidOf(const Matrix3& block);

// Both ellipsoids of a 6x6 matrix. Of a compliance C: displacement under all unit forces (m/N) and rotation under all
// unit moments (rad/(N m)), all other motion free. Of a stiffness K: force for all unit displacements without rotation
// (N/m), moment for all unit rotations without displacement (N m/rad). So the ellipsoid of K is the inverse of that of C only
// if the coupling block is zero. The rotational one of C and the translational one of K are the same about every point.
struct EllipsoidPair {
  Ellipsoid translation, rotation;
};
EllipsoidPair ellipsoidsOf(const Matrix6& matrix);

}  // namespace live_stiffness
