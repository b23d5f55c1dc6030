#include "live_stiffness/analysis/elastic_centre.h"

#include <Eigen/Cholesky>

#include "live_stiffness/analysis/ellipsoid.h"
#include "live_stiffness/analysis/stiffness_matrix.h"

namespace live_stiffness {
namespace {

// The vector a of the antisymmetric M - M^T = hat(a).
Vector3 antisymmetryOf(const Matrix3& M) { return {M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1)}; }

// hat(d) S + S hat(d) = hat((tr(S) I - S) d) for symmetric S. Solves (tr(S) I - S) d = a, positive definite if S is.
bool solveForOffset(const Matrix3& S, const Vector3& a, Vector3& d) {
  const double size = S.trace();
  if (!(size > 0.0)) return false;
  const Eigen::LLT<Matrix3> cholesky(Matrix3::Identity() - S / size);
  if (cholesky.info() != Eigen::Success) return false;
  d = cholesky.solve(a / size);
  return d.allFinite();
}

void fillNormalForm(ElasticCentre& centre) {
  const Ellipsoid coupling = ellipsoidOf(centre.matrix.topRightCorner<3, 3>());
  centre.axes = coupling.directions;
  centre.coupling = coupling.half_axes;
}

}  // namespace

ElasticCentre centreOfStiffness(const Matrix6& K) {
  ElasticCentre centre;
  const Matrix6 symmetric = 0.5 * K + 0.5 * K.transpose();
  // About o + d the coupling is K_fw + K_fv hat(d).
  centre.exists =
      symmetric.allFinite() &&
      solveForOffset(symmetric.topLeftCorner<3, 3>(), -antisymmetryOf(symmetric.topRightCorner<3, 3>()), centre.offset);
  if (!centre.exists) return centre;
  centre.matrix = shiftStiffness(symmetric, centre.offset);
  fillNormalForm(centre);
  return centre;
}

ElasticCentre centreOfCompliance(const Matrix6& C) {
  ElasticCentre centre;
  const Matrix6 symmetric = 0.5 * C + 0.5 * C.transpose();
  // About o + d the coupling is C_mv - hat(d) C_mw.
  centre.exists =
      symmetric.allFinite() && solveForOffset(symmetric.bottomRightCorner<3, 3>(),
                                              antisymmetryOf(symmetric.topRightCorner<3, 3>()), centre.offset);
  if (!centre.exists) return centre;
  centre.matrix = shiftCompliance(symmetric, centre.offset);
  fillNormalForm(centre);
  return centre;
}

}  // namespace live_stiffness
