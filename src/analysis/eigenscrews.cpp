#include "live_stiffness/analysis/eigenscrews.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "lie/matrix6.h"
#include "live_stiffness/analysis/elastic_centre.h"
#include "live_stiffness/analysis/stiffness_matrix.h"

namespace live_stiffness {
namespace {

// Lower Cholesky factor; false unless positive definite.
bool factorise(const Matrix6& a, Matrix6& L) {
  const Eigen::LLT<Matrix6> cholesky(a);
  L = cholesky.matrixL();
  return cholesky.info() == Eigen::Success && L.diagonal().minCoeff() > 0.0 && L.allFinite();
}

// L^T Delta L, symmetric.
Matrix6 overDelta(const Matrix6& L) {
  const Matrix6 half = L.topRows<3>().transpose() * L.bottomRows<3>();
  return half + half.transpose();
}

// Eigenvalues come ascending: the positive ones from the end, then the negative ones from the start.
constexpr int kOrder[6] = {5, 4, 3, 0, 1, 2};

}  // namespace

EigenscrewDecomposition eigenscrewsOfStiffness(const Matrix6& K) {
  EigenscrewDecomposition result;
  const ElasticCentre centre = centreOfStiffness(K);
  Matrix6 L;
  if (!centre.exists || !factorise(centre.matrix, L)) return result;
  result.asymmetry = asymmetryOf(K);
  const SymmetricEigen eigen = eigenOfSymmetric(overDelta(L));
  const Matrix6 vectors = L * eigen.vectors;
  for (int i = 0; i < 6; ++i) {
    const Vector6 column = vectors.col(kOrder[i]);  // a screw [n; m]
    const Vector3 along = linear(column), about = angular(column);
    const double size = along.norm();
    if (!(size > 0.0) || !std::isfinite(1.0 / size)) return result;
    Eigenscrew& screw = result.screws[i];
    screw.eigenvalue = eigen.values[kOrder[i]];
    screw.coefficient = size * size;
    screw.direction = along / size;
    Eigen::Index largest;
    screw.direction.cwiseAbs().maxCoeff(&largest);
    const double sign = screw.direction[largest] < 0.0 ? -1.0 : 1.0;
    screw.pitch = screw.direction.dot(about) / size;
    const Vector3 from_centre = screw.direction.cross(about) / size;
    const Vector3 point = centre.offset + from_centre;
    screw.point = point - screw.direction.dot(point) * screw.direction;
    screw.direction *= sign;
  }
  result.definite = true;
  return result;
}

Eigenstiffnesses eigenstiffnessesOfCompliance(const Matrix6& C) {
  Eigenstiffnesses result;
  Matrix6 L;
  if (!factorise(0.5 * C + 0.5 * C.transpose(), L)) return result;
  const Vector6 compliances = eigenOfSymmetric(overDelta(L)).values;  // ascending: three negative, three positive
  if (!(compliances[2] < 0.0) || !(compliances[3] > 0.0)) return result;
  result.definite = true;
  constexpr int kLargestFirst[6] = {3, 4, 5, 2, 1, 0};  // the smallest compliance is the largest stiffness
  for (int i = 0; i < 6; ++i) result.values[i] = 1.0 / compliances[kLargestFirst[i]];
  return result;
}

}  // namespace live_stiffness
