#include "live_stiffness/analysis/elastic_centre.h"

#include <Eigen/Cholesky>

#include "live_stiffness/analysis/ellipsoid.h"
#include "live_stiffness/analysis/stiffness_matrix.h"

namespace live_stiffness {
namespace {

// The vector a of the antisymmetric M - M^T = hat(a).
Vector3 antisymmetryOf(const Matrix3& M) { return {M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1)}; }

// The centre at offset d with (tr(S) I - S) d = a, where hat(d) S + S hat(d) = hat((tr(S) I - S) d) for symmetric S. The
// system is positive definite if S is. shift: moves the matrix by an offset.
ElasticCentre centreAt(const Matrix6& symmetric, const Matrix3& S, const Vector3& a,
                       Matrix6 (*shift)(const Matrix6& matrix, const Vector3& offset)) {
  ElasticCentre centre;
  const double size = S.trace();
  if (!symmetric.allFinite() || !(size > 0.0)) return centre;
  const Eigen::LLT<Matrix3> cholesky(Matrix3::Identity() - S / size);
  if (cholesky.info() != Eigen::Success) return centre;
  centre.offset = cholesky.solve(a / size);
  centre.exists = centre.offset.allFinite();
  if (!centre.exists) return centre;
  centre.matrix = shift(symmetric, centre.offset);
  const Ellipsoid coupling = ellipsoidOf(centre.matrix.topRightCorner<3, 3>());
  centre.axes = coupling.directions;
  centre.coupling = coupling.half_axes;
  return centre;
}

}  // namespace

ElasticCentre centreOfStiffness(const Matrix6& K) {
  const Matrix6 symmetric = 0.5 * K + 0.5 * K.transpose();
  // About o + d the coupling is K_fw + K_fv hat(d).
  return centreAt(symmetric, symmetric.topLeftCorner<3, 3>(), -antisymmetryOf(symmetric.topRightCorner<3, 3>()),
                  shiftStiffness);
}

ElasticCentre centreOfCompliance(const Matrix6& C) {
  const Matrix6 symmetric = 0.5 * C + 0.5 * C.transpose();
  // About o + d the coupling is C_mv - hat(d) C_mw.
  return centreAt(symmetric, symmetric.bottomRightCorner<3, 3>(), antisymmetryOf(symmetric.topRightCorner<3, 3>()),
                  shiftCompliance);
}

}  // namespace live_stiffness
