#pragma once
// Material of a segment: how its Young's modulus changes with stretch and pressure, and how it creeps.

namespace live_stiffness {

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

struct Material {
  StretchLaw law = StretchLaw::kSectionUpdate;
  double gent_limit = 0.0;  // J_m, - (kGent)
  double yeoh_c2 = 0.0;     // C_20 / C_10, - (kYeoh)
  double yeoh_c3 = 0.0;     // C_30 / C_10, - (kYeoh)
  // b, -: pressure P in chamber k adds the axial stiffness b P A_P at the chamber's centre. Shi et al. section 6.2:
  // "the pressurised chambers may stiffen the robot to some extent". Not negative.
  double pressure_stiffening = 0.0;
  // One exponential creep mode: the share of the pressures' effect that comes later, and its time constant. The
  // model itself is static; see estimation/creep.h. Share 0: no creep.
  double creep_share = 0.0;  // -, 0 to below 1
  double creep_time = 1.0;   // s
};

// E_t / E at a stretch. Not positive where the law is not stable (Gent beyond its limit, Yeoh with negative coefficients).
inline double tangentRatio(const Material& material, double stretch) {
  if (material.law == StretchLaw::kSectionUpdate) return 1.0;
  const double square = stretch * stretch;
  const double of_neo_hookean = (square + 2.0 / stretch) / 3.0;  // lam^2 N'(lam) / E
  if (material.law == StretchLaw::kNeoHookean) return of_neo_hookean;
  const double J = square + 2.0 / stretch - 3.0;
  const double dJ = 2.0 * (stretch - 1.0 / square);
  const double stress = (stretch - 1.0 / square) / 3.0;  // N / E
  if (material.law == StretchLaw::kGent) {
    const double room = material.gent_limit - J;
    if (!(room > 0.0)) return 0.0;
    const double factor = material.gent_limit / room;
    return of_neo_hookean * factor + square * stress * dJ * factor / room;
  }
  const double factor = 1.0 + 2.0 * material.yeoh_c2 * J + 3.0 * material.yeoh_c3 * J * J;
  return of_neo_hookean * factor + square * stress * dJ * (2.0 * material.yeoh_c2 + 6.0 * material.yeoh_c3 * J);
}

}  // namespace live_stiffness
