#include "live_stiffness/rod/stability.h"

#include <algorithm>

namespace live_stiffness {
namespace {

// All pivots of L D L^T of the symmetric part are positive, with `lifted` added to the diagonal.
template <int n>
bool isPositiveDefinite(const Eigen::Matrix<double, n, n>& a, const double (&lifted)[n]) {
  double l[n][n];
#pragma GCC unroll 6
  for (int j = 0; j < n; ++j) {
#pragma GCC unroll 6
    for (int i = j + 1; i < n; ++i) l[i][j] = 0.5 * (a(i, j) + a(j, i));
    l[j][j] = a(j, j) + lifted[j];
  }
#pragma GCC unroll 6
  for (int k = 0; k < n; ++k) {
    if (!(l[k][k] > 0.0)) return false;
    const double inverse = 1.0 / l[k][k];
#pragma GCC unroll 6
    for (int j = k + 1; j < n; ++j) {
      const double factor = l[j][k] * inverse;
#pragma GCC unroll 6
      for (int i = j; i < n; ++i) l[i][j] -= factor * l[i][k];
    }
  }
  return true;
}

// Of a rod without elongation the compliance is singular, and rounding decides its sign. Beyond buckling the negative
// part is as large as the loads are small.
constexpr double kRounding = 1e-11;

// Of a neutral equilibrium rounding, or the error of discretisation, decides what is left of the compliance. So it
// must not be larger than that of the softest segment by more than leaves a digit.
bool isNeutral(double rotation, double softness, double error) {
  const double neutral = std::min(1e7, 0.1 / error);
  return !(rotation < neutral * softness);
}

}  // namespace

double loadNumber(const Chain& chain, const DeadLoads& loads, const Backbone& backbone) {
  Vector3 n = loads.baseForce(chain);
  double softness = 0.0, load_number = 0.0;  // of all before, rad / (N m)
  for (const Chain::Part& part : chain.parts) {
    if (part.segment >= 0) {
      const RestState& rest = backbone.rest[part.segment];
      const double length = rest.stretch * part.length;
      const double own = rest.c.bending_torsion.diagonal().maxCoeff() * length;
      load_number += n.norm() * length * (softness + 0.5 * own);
      softness += own;
    } else {
      load_number += n.norm() * part.length * softness;
    }
    n -= part.mass * loads.gravity;
  }
  return load_number + n.norm() * chain.tip_offset.norm() * softness + angular(loads.tip).norm() * softness / kPi;
}

bool isTipStable(const Matrix6& C, double softness, double error) {
  const double translation = C.topLeftCorner<3, 3>().trace(), rotation = C.bottomRightCorner<3, 3>().trace();
  if (!(translation > 0.0) || isNeutral(rotation, softness, error)) return false;
  const double linear = kRounding * translation, angular = kRounding * rotation;
  return isPositiveDefinite<6>(C, {linear, linear, linear, angular, angular, angular});
}

bool isTipTurningStable(const Matrix3& C, double softness, double error) {
  const double angular = kRounding * C.trace();
  return !isNeutral(C.trace(), softness, error) && isPositiveDefinite<3>(C, {angular, angular, angular});
}

}  // namespace live_stiffness
