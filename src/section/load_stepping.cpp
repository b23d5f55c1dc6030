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

}  // namespace

int stepCount(double largest_pressure, double pressure_step) {
  const double steps = largest_pressure / pressure_step - 1e-9;
  const int whole = static_cast<int>(steps);  // std::ceil is a call where SSE4.1 is not taken for granted
  return std::max(1, whole + (steps > whole));
}

LoadStepper::LoadStepper(const CrossSection& section)
    : section_(section), wrench_of_pressures_(3, section.chambers.count()) {
  for (int k = 0; k < section.chambers.count(); ++k) {
    const Vector3 d = section.chambers.centre(k, 1.0);
    wrench_of_pressures_.col(k) = section.chambers.area() * Vector3(1.0, d.y(), -d.x());  // e3, d x e3
  }
}

// (12), (15), (30): increments with the compliance and chamber positions of the step before. In quantities times powers
// of lam, so that a step waits for one division only.
RestState LoadStepper::fixedSteps(double force, const Eigen::Vector2d& moment, int steps) const {
  double stretch = 1.0, x = 0.0, y = 0.0;
  const double step = 1.0 / (steps * section_.youngsModulus()), pull = step * force;
  for (int i = 0; i < steps; ++i) {
    const SectionMoments::Scaled scaled = section_.scaled(stretch);
    if (!scaled.isValid()) return outOfRange(stretch);
    // I^-1 dT, with 1 / sqrt(lam) as the pitch radius shrinks.
    const double by_moment = step * stretch * std::sqrt(stretch) / scaled.determinant();
    x += by_moment * (scaled.yy * moment.x() - scaled.xy * moment.y());
    y += by_moment * (scaled.xx * moment.y() - scaled.xy * moment.x());
    stretch += pull * stretch * stretch / scaled.area;  // lam dF / (E A)
  }
  if (!section_.isValidAt(stretch)) return outOfRange(stretch);
  RestState state;
  state.stretch = stretch;
  state.curvature.head<2>() << x, y;
  state.c = section_.complianceDensity(stretch);
  return state;
}

RestState LoadStepper::linearStep(double force, const Eigen::Vector2d& moment) const {
  RestState state;
  state.c = section_.complianceDensity(1.0);
  state.curvature.head<2>() = state.c.bending_torsion.topLeftCorner<2, 2>() * moment;
  state.stretch = 1.0 + state.c.shear_elongation(2, 2) * force;
  if (!(state.stretch > 0.0)) return outOfRange(state.stretch);
  return state;
}

// u_rest = int dT / (E I) with dT / dF constant but for the pitch radius, dF = E A / lam dlam:
//   u_rest = (e / F) int_0^1 I(lam)^-1 T(1) A(lam) lam^(-3/2) dx,  lam = 1 + x e.
RestState LoadStepper::continuousSteps(double force, const Eigen::Vector2d& moment) const {
  const double e = elongationFor(section_, force);
  const double lam_end = 1.0 + e;
  if (!section_.isValidAt(lam_end)) return outOfRange(lam_end);
  Eigen::Vector2d integral = Eigen::Vector2d::Zero();
  constexpr int kPanels = 4, kNodes = 6;
  const GaussLegendre& table = gaussLegendre(kNodes);
  for (int panel = 0; panel < kPanels; ++panel) {
    for (int i = 0; i < kNodes; ++i) {
      const double lam = 1.0 + e * (panel + table.c[i]) / kPanels;
      const double weight = table.b[i] / kPanels;
      integral += weight * section_.area(lam) / (lam * std::sqrt(lam)) * (section_.secondMoments(lam).inverse() * moment);
    }
  }
  RestState state;
  state.stretch = lam_end;
  state.curvature.head<2>() = integral / forcePerElongation(section_, e);
  state.c = section_.complianceDensity(lam_end);
  return state;
}

RestState LoadStepper::restState(PressuresRef pressures, Stepping stepping, int steps) const {
  Vector3 wrench = Vector3::Zero();
  for (int k = 0; k < pressures.size(); ++k) wrench += pressures[k] * wrench_of_pressures_.col(k);
  const Eigen::Vector2d moment = wrench.tail<2>();
  switch (stepping) {
    case Stepping::kFixedStep: return fixedSteps(wrench[0], moment, steps);
    case Stepping::kContinuous: return continuousSteps(wrench[0], moment);
    case Stepping::kLinear: return linearStep(wrench[0], moment);
  }
  return outOfRange(1.0);
}

RestState restState(const CrossSection& section, PressuresRef pressures, Stepping stepping, int steps) {
  return LoadStepper(section).restState(pressures, stepping, steps);
}

}  // namespace live_stiffness
