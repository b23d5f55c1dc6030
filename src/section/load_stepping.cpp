#include "section/load_stepping.h"

#include <algorithm>
#include <cmath>

#include "gauss_legendre.h"

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
    : section_(section), area_growth_(section.chambers.area_growth), wrench_of_pressures_(3, section.chambers.count()) {
  const double A_P = section.chambers.area();
  const bool stiffens = section.material.pressure_stiffening != 0.0;
  if (stiffens) stiffness_of_pressures_.resize(4, section.chambers.count());
  for (int k = 0; k < section.chambers.count(); ++k) {
    const Vector3 d = section.chambers.centre(k, 1.0);
    wrench_of_pressures_.col(k) << A_P, A_P * d.y(), -A_P * d.x();  // e3, d x e3
    if (!stiffens) continue;
    const double weight = section.material.pressure_stiffening * A_P;
    const Eigen::Matrix2d spread = armSpread(d, weight);
    stiffness_of_pressures_.col(k) << weight, spread(0, 0), spread(0, 1), spread(1, 1);
  }
}

LoadStepper::Actuation LoadStepper::actuation(PressuresRef pressures) const {
  Vector3 wrench = Vector3::Zero();
  for (int k = 0; k < pressures.size(); ++k)
    wrench += wrench_of_pressures_.col(k) * (pressures[k] + area_growth_ * pressures[k] * pressures[k]);
  Actuation on;
  on.force = wrench[0];
  on.moment << wrench[1], wrench[2];
  if (stiffness_of_pressures_.cols() == 0) return on;
  Eigen::Vector4d stiffness = Eigen::Vector4d::Zero();
  for (int k = 0; k < pressures.size(); ++k) stiffness += stiffness_of_pressures_.col(k) * pressures[k];
  on.stiffness.axial = stiffness[0];
  on.stiffness.bending << stiffness[1], stiffness[2], stiffness[2], stiffness[3];
  return on;
}

// (12), (15), (30): increments with the compliance and chamber positions of the step before. In quantities times powers of
// lam, so that a step waits for one division only.
RestState LoadStepper::fixedSteps(const Actuation& on, int steps) const {
  double stretch = 1.0, x = 0.0, y = 0.0;
  const double step = 1.0 / (steps * section_.youngsModulus()), pull = step * on.force;
  const double moment_x = on.moment.x(), moment_y = on.moment.y();
  for (int i = 0; i < steps; ++i) {
    const auto scaled = section_.scaled(stretch);
    if (!scaled.isValid()) return outOfRange(stretch);
    // I^-1 dT, with 1 / sqrt(lam) as the pitch radius shrinks.
    const double by_moment = step * stretch * std::sqrt(stretch) / scaled.determinant();
    x += by_moment * (scaled.yy * moment_x - scaled.xy * moment_y);
    y += by_moment * (scaled.xx * moment_y - scaled.xy * moment_x);
    stretch += pull * stretch * stretch / scaled.area;  // lam dF / (E A)
  }
  if (!section_.isValidAt(stretch)) return outOfRange(stretch);
  return {stretch, Vector3(x, y, 0.0), section_.complianceDensity(stretch)};
}

// The same with the stretch law and the stiffness that the pressures reached so far add.
RestState LoadStepper::fixedMaterialSteps(const Actuation& on, int steps) const {
  double stretch = 1.0;
  Eigen::Vector2d curvature = Eigen::Vector2d::Zero();
  for (int i = 0; i < steps; ++i) {
    const ChamberStiffness pressurised = on.share(static_cast<double>(i) / steps);
    if (!section_.isValidAt(stretch, pressurised)) return outOfRange(stretch);
    const Eigen::Matrix2d softness = SectionMoments::inverse(section_.bendingStiffness(stretch, pressurised));
    curvature += softness * on.moment / (steps * std::sqrt(stretch));
    stretch += stretch * on.force / (steps * section_.axialStiffness(stretch, pressurised));
  }
  if (!section_.isValidAt(stretch, on.stiffness)) return outOfRange(stretch);
  RestState state;
  state.stretch = stretch;
  state.curvature.head<2>() = curvature;
  state.c = section_.complianceDensity(stretch, on.stiffness);
  return state;
}

RestState LoadStepper::linearStep(const Actuation& on) const {
  RestState state;
  state.c = section_.complianceDensity(1.0);
  state.curvature.head<2>() = state.c.bending_torsion.topLeftCorner<2, 2>() * on.moment;
  state.stretch = 1.0 + state.c.shear_elongation(2, 2) * on.force;
  if (!(state.stretch > 0.0)) return outOfRange(state.stretch);
  return state;
}

// u_rest = int dT / (E I) with dT / dF constant but for the pitch radius, dF = E A / lam dlam:
//   u_rest = (e / F) int_0^1 I(lam)^-1 T(1) A(lam) lam^(-3/2) dx,  lam = 1 + x e.
RestState LoadStepper::continuousSteps(const Actuation& on) const {
  const double e = elongationFor(section_, on.force);
  const double lam_end = 1.0 + e;
  if (!section_.isValidAt(lam_end)) return outOfRange(lam_end);
  Eigen::Vector2d integral = Eigen::Vector2d::Zero();
  constexpr int kPanels = 4, kNodes = 6;
  const GaussLegendre& table = gaussLegendre(kNodes);
  for (int panel = 0; panel < kPanels; ++panel) {
    for (int i = 0; i < kNodes; ++i) {
      const double lam = 1.0 + e * ((panel + table.c[i]) / kPanels);
      const double weight = (table.b[i] / kPanels) * section_.area(lam) / (lam * std::sqrt(lam));
      integral += (SectionMoments::inverse(section_.secondMoments(lam)) * on.moment) * weight;
    }
  }
  RestState state;
  state.stretch = lam_end;
  state.curvature.head<2>() = integral / forcePerElongation(section_, e);
  state.c = section_.complianceDensity(lam_end);
  return state;
}

// With t the share of the pressures: d ln lam = F dt / (E_t A + t F_b), du = (E_t I + t S_b)^-1 T(1) / sqrt(lam) dt, by
// Gauss-Legendre collocation of ln lam (order 12), its nodes by fixed point.
RestState LoadStepper::continuousMaterialSteps(const Actuation& on) const {
  constexpr int kPanels = 4, kNodes = 6, kMostPasses = 60;
  const GaussLegendre& table = gaussLegendre(kNodes);
  double log_stretch = 0.0;
  Eigen::Vector2d curvature = Eigen::Vector2d::Zero();
  for (int panel = 0; panel < kPanels; ++panel) {
    double stretch[kNodes], rate[kNodes];
    for (double& at : stretch) at = std::exp(log_stretch);
    bool moved = true;
    for (int pass = 0; pass < kMostPasses && moved; ++pass) {
      for (int i = 0; i < kNodes; ++i) {
        const ChamberStiffness pressurised = on.share((panel + table.c[i]) / kPanels);
        const double stiffness = section_.axialStiffness(stretch[i], pressurised);
        if (!(stretch[i] > 0.0 && section_.area(stretch[i]) > 0.0 && stiffness > 0.0)) return outOfRange(stretch[i]);
        rate[i] = on.force / (kPanels * stiffness);
      }
      moved = false;
      for (int i = 0; i < kNodes; ++i) {
        double at = log_stretch;
        for (int j = 0; j < kNodes; ++j) at += table.a[j][i] * rate[j];
        const double next = std::exp(at);
        moved = moved || !(std::abs(next - stretch[i]) < 1e-15 * next);
        stretch[i] = next;
      }
    }
    for (int i = 0; i < kNodes; ++i) {
      const ChamberStiffness pressurised = on.share((panel + table.c[i]) / kPanels);
      if (!section_.isValidAt(stretch[i], pressurised)) return outOfRange(stretch[i]);
      const Eigen::Matrix2d softness = SectionMoments::inverse(section_.bendingStiffness(stretch[i], pressurised));
      curvature += (softness * on.moment) * (table.b[i] / (kPanels * std::sqrt(stretch[i])));
      log_stretch += table.b[i] * rate[i];
    }
  }
  RestState state;
  state.stretch = std::exp(log_stretch);
  if (!section_.isValidAt(state.stretch, on.stiffness)) return outOfRange(state.stretch);
  state.curvature.head<2>() = curvature;
  state.c = section_.complianceDensity(state.stretch, on.stiffness);
  return state;
}

RestState LoadStepper::restState(PressuresRef pressures, Stepping stepping, int steps) const {
  const Actuation on = actuation(pressures);
  const bool plain = section_.isPlain();
  switch (stepping) {
    case Stepping::kFixedStep: return plain ? fixedSteps(on, steps) : fixedMaterialSteps(on, steps);
    case Stepping::kContinuous: return plain ? continuousSteps(on) : continuousMaterialSteps(on);
    case Stepping::kLinear: return linearStep(on);
  }
  return outOfRange(1.0);
}

}  // namespace live_stiffness
