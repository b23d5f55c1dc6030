#pragma once
// Stiffness from compliance (17), about any point and in any axes; of compliances se3.h has the same (18).

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

// K = C^-1 about the same point, same axes (17): wrench that a small twist takes.
struct StiffnessMatrix {
  bool invertible = false;  // false: nothing else but `condition` holds
  double length = 0.0;      // by which moments were scaled to forces, m: sqrt(tr C_fv / tr C_mw)
  double condition = 0.0;   // of C so scaled, in the 1-norm; infinity if exactly singular
  Matrix6 K = Matrix6::Zero();
};

// Entries of C have units, so its condition as it stands means nothing: lengths in mm alone would change it by 1e6.
// Scaled by a length of its own it does not depend on units. Not invertible: not finite, no positive traces, or a
// condition above 1e14, where no digit of K would be right (a rod without elongation, or at the brink of buckling).
// C need not be symmetric. The error of K is about 1e-16 times `condition`, relative and scaled.
StiffnessMatrix stiffnessOf(const Matrix6& C);

// K about the point o becomes K about the point o + offset, same axes: H^-T K H^-1. Other axes: as complianceInBodyAxes().
Matrix6 shiftStiffness(const Matrix6& K, const Vector3& offset);

// How unsymmetric a compliance or stiffness matrix is: norm of the antisymmetric part over that of the symmetric, both
// scaled by the matrix's own length; 0: symmetric. Not zero under a dead tip moment, which is not conservative.
double asymmetryOf(const Matrix6& matrix);

// The matrix with its angular rows and columns times `factor`.
Matrix6 withAngularScaled(const Matrix6& matrix, double factor);

}  // namespace live_stiffness
