#include "live_stiffness/section/load_stepping.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "live_stiffness/gauss_legendre.h"

namespace live_stiffness {
namespace {

RestState outOfRange(double stretch) {
  RestState state;
  state.stretch = stretch;
  state.valid = false;
  return state;
}

// (12), (15), (30): increments with the compliance and chamber positions of the step before.
RestState fixedSteps(const SectionMoments& section, double force, const Vector3& moment, int steps) {
  RestState state;
  state.c = section.complianceDensity(1.0);
  for (int step = 0; step < steps; ++step) {
    state.curvature += state.c.bending_torsion * (moment / (steps * std::sqrt(state.stretch)));
    state.stretch *= 1.0 + state.c.shear_elongation(2, 2) * (force / steps);
    if (!section.isValidAt(state.stretch)) return outOfRange(state.stretch);
    state.c = section.complianceDensity(state.stretch);
  }
  return state;
}

RestState linearStep(const SectionMoments& section, double force, const Vector3& moment) {
  RestState state;
  state.c = section.complianceDensity(1.0);
  state.curvature = state.c.bending_torsion * moment;
  state.stretch = 1.0 + state.c.shear_elongation(2, 2) * force;
  if (!(state.stretch > 0.0)) return outOfRange(state.stretch);
  return state;
}

// Force that holds stretch 1 + e in the limit of small steps, divided by e: with dlam / lam = dF / (E A(lam)),
//   F(lam) = pi E [ (r_m1^2 - r_m2^2) (1 - 1/lam) - N r_P^2 ln lam ],
// written so that neither F nor F / e loses digits at e = 0.
double forcePerElongation(const SectionMoments& section, double e) {
  const double log_over_e = std::abs(e) < 1e-8 ? 1.0 - 0.5 * e : std::log1p(e) / e;
  return section.youngsModulus() * (section.tubeArea() / (1.0 + e) - section.chamberArea() * log_over_e);
}

// Elongation e = lam - 1 with F(1 + e) = force, or the one where A(lam) = 0 when no stretch holds that force.
// F grows from -infinity (lam = 0) to its maximum at A(lam) = 0; Newton, safeguarded by bisection.
double elongationFor(const SectionMoments& section, double force) {
  double low = -1.0;
  double high = section.chamberArea() > 0.0 ? section.area(1.0) / section.chamberArea() : 1e6;
  if (force >= forcePerElongation(section, high) * high) return high;
  double e = std::clamp(force / (section.youngsModulus() * section.area(1.0)), 0.5 * low, 0.5 * high);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double residual = forcePerElongation(section, e) * e - force;
    (residual > 0.0 ? high : low) = e;
    const double slope = section.youngsModulus() * section.area(1.0 + e) / (1.0 + e);
    double next = e - residual / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - e) <= 1e-16 * (1.0 + std::abs(e))) return next;
    e = next;
  }
  return e;
}

// u_rest = int dT / (E I) with dT / dF constant but for the pitch radius, dF = E A / lam dlam:
//   u_rest = (e / F) int_0^1 I(lam)^-1 T(1) A(lam) lam^(-3/2) dx,  lam = 1 + x e.
RestState continuousSteps(const SectionMoments& section, double force, const Vector3& moment) {
  const double e = elongationFor(section, force);
  const double lam_end = 1.0 + e;
  if (!section.isValidAt(lam_end)) return outOfRange(lam_end);
  Eigen::Vector2d integral = Eigen::Vector2d::Zero();
  constexpr int kPanels = 4;
  for (int panel = 0; panel < kPanels; ++panel) {
    for (int i = 0; i < kStages; ++i) {
      const double lam = 1.0 + e * (panel + gaussLegendre().c[i]) / kPanels;
      const double weight = gaussLegendre().b[i] / kPanels;
      integral += weight * section.area(lam) / (lam * std::sqrt(lam)) *
                  (section.secondMoments(lam).inverse() * moment.head<2>());
    }
  }
  RestState state;
  state.stretch = lam_end;
  state.curvature.head<2>() = integral / forcePerElongation(section, e);
  state.c = section.complianceDensity(lam_end);
  return state;
}

}  // namespace

int stepCount(double largest_pressure, double pressure_step) {
  const double steps = std::ceil(largest_pressure / pressure_step - 1e-9);
  return std::max(1, static_cast<int>(steps));
}

RestState restState(const CrossSection& section, PressuresRef pressures, Stepping stepping, int steps) {
  const SectionMoments moments(section);
  const double force = section.chambers.actuationForce(pressures);
  const Vector3 moment = section.chambers.actuationMoment(pressures, 1.0);
  switch (stepping) {
    case Stepping::kFixedStep: return fixedSteps(moments, force, moment, steps);
    case Stepping::kContinuous: return continuousSteps(moments, force, moment);
    case Stepping::kLinear: return linearStep(moments, force, moment);
  }
  return outOfRange(1.0);
}

}  // namespace live_stiffness
