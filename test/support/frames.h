#pragma once
// Compliance and stiffness in another frame, for tests of what must not depend on it.

#include "live_stiffness/analysis/stiffness_matrix.h"

namespace live_stiffness {

// C about the origin of O in axes of O becomes C about the origin of F in axes of F: (18), Ad^T C Ad; and K alike.
inline Matrix6 complianceInFrame(const Matrix6& C, const Pose& X_OF) {
  return complianceInBodyAxes(shiftCompliance(C, X_OF.p), X_OF.R);
}
inline Matrix6 stiffnessInFrame(const Matrix6& K, const Pose& X_OF) {
  return complianceInBodyAxes(shiftStiffness(K, X_OF.p), X_OF.R);
}

}  // namespace live_stiffness
