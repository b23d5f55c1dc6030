#include "rod/stability.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

// The bending compliance c that counts against a force n, rad/(N m^2). If a rod turns by phi more, the work of n is the
// form (n . phi)(t . phi) - (n . t) |phi|^2, t the tangent. For t opposite to n this is |n| |phi|^2, of bending only; for t
// normal to n it mixes bending with torsion. Times c it is largest for t opposite to n, unless torsion is more than twice as
// compliant as bending.
double complianceToForce(const Matrix3& c) {
  const double bending = std::max(c(0, 0), c(1, 1)), torsion = c(2, 2);
  return torsion > 2.0 * bending ? 0.5 * torsion / std::sqrt(torsion / bending - 1.0) : bending;
}

}  // namespace

// Of M(s, l) = C(min(s, l)) in the measure |n| ds the largest eigenvalue is at most the root of the sum of all squared,
//   int int C(min(s, l))^2 |n(s)| |n(l)| ds dl = sum over parts p of the same within p, and 2 |n|_p int_{s < p} C^2 |n| ds.
// Within a segment C and |n| are interpolated linearly (|n| is convex, so this is an upper bound).
double normalisedLoad(const Chain& chain, const DeadLoads& loads, const Backbone& backbone) {
  const GaussLegendre& gauss = gaussLegendre(3);  // exact for the polynomials below
  Vector3 n = loads.baseForce(chain);
  double bending_compliance = 0.0;  // C here, rad / (N m)
  double most_compliant = 0.0;   // largest compliance of the whole robot to a moment about any axis, rad / (N m)
  double before = 0.0;    // int of C^2 |n| up to here
  double sum = 0.0;
  const auto addRigid = [&](double load) {
    const double own = load * bending_compliance * bending_compliance;
    sum += load * (2.0 * before + own);
    before += own;
  };
  for (const Chain::Part& part : chain.parts) {
    const double n_start = n.norm();
    n -= part.mass * loads.gravity;
    if (part.segment < 0) {
      addRigid(0.5 * (n_start + n.norm()) * part.length);  // its mass acts at its middle
      continue;
    }
    const RestState& rest = backbone.rest[part.segment];
    const double length = rest.stretch * part.length;
    const double own = complianceToForce(rest.c.bending_torsion) * length;
    const double start = n_start * length, change = n.norm() * length - start;
    double within = 0.0, passed = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double x = gauss.c[i], C = bending_compliance + x * own;
      const double weighted = gauss.b[i] * C * C * (start + x * change);
      passed += weighted;
      within += weighted * (1.0 - x) * (start + 0.5 * (1.0 + x) * change);
    }
    sum += 2.0 * (before * (start + 0.5 * change) + within);
    before += passed;
    bending_compliance += own;
    most_compliant += rest.c.bending_torsion.diagonal().maxCoeff() * length;
  }
  addRigid(n.norm() * chain.tip_offset.norm());
  return std::sqrt(sum) + angular(loads.tip).norm() * most_compliant / kPi;
}

bool isNeutral(double growth, double error) { return !(growth < std::min(1e7, 0.1 / error)); }

}  // namespace live_stiffness
