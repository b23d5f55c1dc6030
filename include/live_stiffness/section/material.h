#pragma once
// Material of a segment: how its Young's modulus changes with stretch and pressure, and how it creeps.
//
// T is double, or a type that carries derivatives.

#include <type_traits>

namespace live_stiffness {

// True if x is zero and constant: if its type carries derivatives (a, v as in ceres::Jet), these must be zero, too.
template <class T>
bool isZeroForGood(const T& x) {
  if constexpr (std::is_floating_point_v<T>) return x == 0.0;
  else return x.a == 0.0 && x.v.isZero(0.0);
}

// Uniaxial law of an incompressible elastomer, as the ratio of its tangent modulus to E. A section under the axial
// force F = A0 N(lam), N the nominal stress, has dF = E_t A dlam / lam, and for small bending in addition to the stretch
// dM = E_t I dkappa (curvature per stretched length). Both have E_t = lam^2 N'(lam), because the fibre at y is stretched to
// lam (1 + kappa y); A and I are those of the stretched section.
enum class StretchLaw {
  kSectionUpdate,  // E_t = E: Shi et al. (12), (24), where only the section changes
  kNeoHookean,     // N = E/3 (lam - lam^-2)
  kGent,           // neo-Hookean times J_m / (J_m - J), J = lam^2 + 2/lam - 3: the stiffness grows without bound towards J = J_m
  kYeoh,           // neo-Hookean times 1 + 2 c2 J + 3 c3 J^2, c2 and c3 in units of the first coefficient C_10 = E/6
};

template <class T>
struct MaterialOf {
  StretchLaw law = StretchLaw::kSectionUpdate;
  T gent_limit = T(0.0);  // J_m, - (kGent)
  T yeoh_c2 = T(0.0);     // C_20 / C_10, - (kYeoh)
  T yeoh_c3 = T(0.0);     // C_30 / C_10, - (kYeoh)
  // b, -: pressure P in chamber k adds the axial stiffness b P A_P at the chamber's centre. Shi et al. section 6.2:
  // "the pressurised chambers may stiffen the robot to some extent". Not negative.
  T pressure_stiffening = T(0.0);
  // One exponential creep mode: the share of the pressures' effect that comes later, and its time constant. The
  // model itself is static; see estimation/creep.h. Share 0: no creep.
  T creep_share = T(0.0);  // -, 0 to below 1
  T creep_time = T(1.0);   // s
};
using Material = MaterialOf<double>;

// E_t / E at a stretch. Not positive where the law is not stable (Gent beyond its limit, Yeoh with negative coefficients).
template <class T>
T tangentRatio(const MaterialOf<T>& material, const T& stretch) {
  if (material.law == StretchLaw::kSectionUpdate) return T(1.0);
  const T square = stretch * stretch;
  const T of_neo_hookean = (square + 2.0 / stretch) / 3.0;  // lam^2 N'(lam) / E
  if (material.law == StretchLaw::kNeoHookean) return of_neo_hookean;
  const T J = square + 2.0 / stretch - 3.0;
  const T dJ = 2.0 * (stretch - 1.0 / square);
  const T stress = (stretch - 1.0 / square) / 3.0;  // N / E
  if (material.law == StretchLaw::kGent) {
    const T room = material.gent_limit - J;
    if (!(room > 0.0)) return T(0.0);
    const T factor = material.gent_limit / room;
    return of_neo_hookean * factor + square * stress * dJ * factor / room;
  }
  const T factor = 1.0 + 2.0 * material.yeoh_c2 * J + 3.0 * material.yeoh_c3 * J * J;
  return of_neo_hookean * factor + square * stress * dJ * (2.0 * material.yeoh_c2 + 6.0 * material.yeoh_c3 * J);
}

}  // namespace live_stiffness
