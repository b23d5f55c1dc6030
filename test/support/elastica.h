#pragma once
// Euler's elastica: the exact tip of an inextensible cantilever of EI = L = 1, clamped along +z, under a dead tip
// force. By elliptic integrals.

#include <cmath>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

// Force of size P at an angle beta (0 < beta < pi) from -z towards +x: (P sin(beta), 0, -P cos(beta)).
// With psi the tangent's angle plus beta, psi'' + P sin(psi) = 0, psi(0) = beta, psi'(1) = 0; sin(psi / 2) = k
// sin(phi). This is the shape of least energy; P above pi^2 / 4 is beyond buckling as beta goes to zero.
inline Vector3 elasticaTip(double P, double beta) {
  const auto phi_at_base = [&](double k) { return std::asin(std::min(1.0, std::sin(0.5 * beta) / k)); };
  const auto excess = [&](double k) {
    return std::comp_ellint_1(k) - std::ellint_1(k, phi_at_base(k)) - std::sqrt(P);
  };
  double low = std::sin(0.5 * beta), high = 1.0 - 1e-16;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? high : low) = middle;
  }
  const double k = 0.5 * (low + high), phi = phi_at_base(k);
  const double along = 2.0 / std::sqrt(P) * (std::comp_ellint_2(k) - std::ellint_2(k, phi)) - 1.0;  // int cos(psi)
  const double across = 2.0 * k / std::sqrt(P) * std::cos(phi);                                     // int sin(psi)
  return {-along * std::sin(beta) + across * std::cos(beta), 0.0, along * std::cos(beta) + across * std::sin(beta)};
}

}  // namespace live_stiffness
