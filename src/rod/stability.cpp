#include "live_stiffness/rod/stability.h"

#include <algorithm>

namespace live_stiffness {
namespace {

// All pivots of L D L^T of the symmetric part are positive, with `lifted` added to the diagonal of each block.
bool isPositiveDefinite(const Matrix6& a, double lifted_linear, double lifted_angular) {
  double l[6][6];
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) l[i][j] = 0.5 * (a(i, j) + a(j, i));
    l[j][j] = a(j, j) + (j < 3 ? lifted_linear : lifted_angular);
  }
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    if (!(l[k][k] > 0.0)) return false;
    const double inverse = 1.0 / l[k][k];
#pragma GCC unroll 6
    for (int j = k + 1; j < 6; ++j) {
      const double factor = l[j][k] * inverse;
#pragma GCC unroll 6
      for (int i = j; i < 6; ++i) l[i][j] -= factor * l[i][k];
    }
  }
  return true;
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
  // Of a neutral equilibrium rounding, or the error of discretisation, decides what is left of the compliance. So it
  // must not be larger than that of the softest segment by more than leaves a digit.
  const double neutral = std::min(1e7, 0.1 / error);
  // Of a rod without elongation the compliance is singular, and rounding decides its sign. Beyond buckling the negative
  // part is as large as the loads are small.
  constexpr double kRounding = 1e-11;
  const double translation = C.topLeftCorner<3, 3>().trace(), rotation = C.bottomRightCorner<3, 3>().trace();
  if (!(translation > 0.0) || !(rotation < neutral * softness)) return false;
  return isPositiveDefinite(C, kRounding * translation, kRounding * rotation);
}

}  // namespace live_stiffness
