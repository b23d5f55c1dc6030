#pragma once
// Definitions of load_stepping.h, for double (load_stepping.cpp) and for types that carry derivatives.

#include <algorithm>
#include <cmath>

#include "gauss_legendre.h"
#include "section/load_stepping.h"

namespace live_stiffness {
namespace load_stepping {

template <class T>
RestStateOf<T> outOfRange(const T& stretch) {
  RestStateOf<T> state;
  state.stretch = stretch;
  state.valid = false;
  return state;
}

// Force that holds stretch 1 + e in the limit of small steps, divided by e: with dlam / lam = dF / (E A(lam)),
//   F(lam) = pi E [ (r_m1^2 - r_m2^2) (1 - 1/lam) - N r_P^2 ln lam ],
// written so that neither F nor F / e loses digits at e = 0.
template <class T>
T forcePerElongation(const SectionMomentsOf<T>& section, const T& e) {
  using std::abs, std::log1p;
  const T log_over_e = abs(e) < 1e-8 ? T(1.0 - 0.5 * e) : T(log1p(e) / e);
  return section.youngsModulus() * (section.tubeArea() / (1.0 + e) - section.chamberArea() * log_over_e);
}

// Elongation e = lam - 1 with F(1 + e) = force, or the one where A(lam) = 0 when no stretch holds that force.
// F grows from -infinity (lam = 0) to its maximum at A(lam) = 0; Newton, safeguarded by bisection.
// With derivatives: the last Newton step gives them exactly, whatever the iterate's were.
template <class T>
T elongationFor(const SectionMomentsOf<T>& section, const T& force) {
  using std::abs;
  T low(-1.0);
  T high = section.chamberArea() > 0.0 ? T(section.area(T(1.0)) / section.chamberArea()) : T(1e6);
  if (force >= forcePerElongation(section, high) * high) return high;
  T e = force / (section.youngsModulus() * section.area(T(1.0)));
  e = std::min(std::max(e, T(0.5 * low)), T(0.5 * high));
  for (int iteration = 0; iteration < 100; ++iteration) {
    const T residual = forcePerElongation(section, e) * e - force;
    (residual > 0.0 ? high : low) = e;
    const T slope = section.youngsModulus() * section.area(T(1.0 + e)) / (1.0 + e);
    T next = e - residual / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (abs(next - e) <= 1e-16 * (1.0 + abs(e))) return next;
    e = next;
  }
  return e;
}

}  // namespace load_stepping

template <class T>
LoadStepperOf<T>::LoadStepperOf(const CrossSectionOf<T>& section)
    : section_(section), area_growth_(section.chambers.area_growth), wrench_of_pressures_(3, section.chambers.count()) {
  const T A_P = section.chambers.area();
  const bool stiffens = !isZeroForGood(section.material.pressure_stiffening);
  if (stiffens) stiffness_of_pressures_.resize(4, section.chambers.count());
  for (int k = 0; k < section.chambers.count(); ++k) {
    const Vector3Of<T> d = section.chambers.centre(k, T(1.0));
    wrench_of_pressures_.col(k) << A_P, A_P * d.y(), -A_P * d.x();  // e3, d x e3
    if (!stiffens) continue;
    const T weight = section.material.pressure_stiffening * A_P;
    const Matrix2Of<T> spread = armSpread(d, weight);
    stiffness_of_pressures_.col(k) << weight, spread(0, 0), spread(0, 1), spread(1, 1);
  }
}

template <class T>
typename LoadStepperOf<T>::Actuation LoadStepperOf<T>::actuation(PressuresRefOf<T> pressures) const {
  Vector3Of<T> wrench = Vector3Of<T>::Constant(T(0.0));
  for (int k = 0; k < pressures.size(); ++k)
    wrench += wrench_of_pressures_.col(k) * T(pressures[k] + area_growth_ * pressures[k] * pressures[k]);
  Actuation on;
  on.force = wrench[0];
  on.moment << wrench[1], wrench[2];
  if (stiffness_of_pressures_.cols() == 0) return on;
  Eigen::Matrix<T, 4, 1> stiffness = Eigen::Matrix<T, 4, 1>::Constant(T(0.0));
  for (int k = 0; k < pressures.size(); ++k) stiffness += stiffness_of_pressures_.col(k) * pressures[k];
  on.stiffness.axial = stiffness[0];
  on.stiffness.bending << stiffness[1], stiffness[2], stiffness[2], stiffness[3];
  return on;
}

// (12), (15), (30): increments with the compliance and chamber positions of the step before. In quantities times powers of
// lam, so that a step waits for one division only.
template <class T>
RestStateOf<T> LoadStepperOf<T>::fixedSteps(const Actuation& on, int steps) const {
  using std::sqrt;
  T stretch(1.0), x(0.0), y(0.0);
  const T step = 1.0 / (static_cast<double>(steps) * section_.youngsModulus()), pull = step * on.force;
  const T moment_x = on.moment.x(), moment_y = on.moment.y();
  for (int i = 0; i < steps; ++i) {
    const auto scaled = section_.scaled(stretch);
    if (!scaled.isValid()) return load_stepping::outOfRange(stretch);
    // I^-1 dT, with 1 / sqrt(lam) as the pitch radius shrinks.
    const T by_moment = step * stretch * sqrt(stretch) / scaled.determinant();
    x += by_moment * (scaled.yy * moment_x - scaled.xy * moment_y);
    y += by_moment * (scaled.xx * moment_y - scaled.xy * moment_x);
    stretch += pull * stretch * stretch / scaled.area;  // lam dF / (E A)
  }
  if (!section_.isValidAt(stretch)) return load_stepping::outOfRange(stretch);
  return {stretch, Vector3Of<T>(x, y, T(0.0)), section_.complianceDensity(stretch)};
}

// The same with the stretch law and the stiffness that the pressures reached so far add.
template <class T>
RestStateOf<T> LoadStepperOf<T>::fixedMaterialSteps(const Actuation& on, int steps) const {
  using std::sqrt;
  T stretch(1.0);
  Vector2Of<T> curvature = Vector2Of<T>::Constant(T(0.0));
  for (int i = 0; i < steps; ++i) {
    const ChamberStiffnessOf<T> pressurised = on.share(static_cast<double>(i) / steps);
    if (!section_.isValidAt(stretch, pressurised)) return load_stepping::outOfRange(stretch);
    const Matrix2Of<T> softness = SectionMomentsOf<T>::inverse(section_.bendingStiffness(stretch, pressurised));
    curvature += (softness * on.moment) * T(1.0 / (static_cast<double>(steps) * sqrt(stretch)));
    stretch += stretch * on.force / (static_cast<double>(steps) * section_.axialStiffness(stretch, pressurised));
  }
  if (!section_.isValidAt(stretch, on.stiffness)) return load_stepping::outOfRange(stretch);
  RestStateOf<T> state;
  state.stretch = stretch;
  state.curvature.template head<2>() = curvature;
  state.c = section_.complianceDensity(stretch, on.stiffness);
  return state;
}

template <class T>
RestStateOf<T> LoadStepperOf<T>::linearStep(const Actuation& on) const {
  RestStateOf<T> state;
  state.c = section_.complianceDensity(T(1.0));
  state.curvature.template head<2>() = state.c.bending_torsion.template topLeftCorner<2, 2>() * on.moment;
  state.stretch = 1.0 + state.c.shear_elongation(2, 2) * on.force;
  if (!(state.stretch > 0.0)) return load_stepping::outOfRange(state.stretch);
  return state;
}

// u_rest = int dT / (E I) with dT / dF constant but for the pitch radius, dF = E A / lam dlam:
//   u_rest = (e / F) int_0^1 I(lam)^-1 T(1) A(lam) lam^(-3/2) dx,  lam = 1 + x e.
template <class T>
RestStateOf<T> LoadStepperOf<T>::continuousSteps(const Actuation& on) const {
  using std::sqrt;
  const T e = load_stepping::elongationFor(section_, on.force);
  const T lam_end = 1.0 + e;
  if (!section_.isValidAt(lam_end)) return load_stepping::outOfRange(lam_end);
  Vector2Of<T> integral = Vector2Of<T>::Constant(T(0.0));
  constexpr int kPanels = 4, kNodes = 6;
  const GaussLegendre& table = gaussLegendre(kNodes);
  for (int panel = 0; panel < kPanels; ++panel) {
    for (int i = 0; i < kNodes; ++i) {
      const T lam = 1.0 + e * ((panel + table.c[i]) / kPanels);
      const T weight = (table.b[i] / kPanels) * section_.area(lam) / (lam * sqrt(lam));
      integral += (SectionMomentsOf<T>::inverse(section_.secondMoments(lam)) * on.moment) * weight;
    }
  }
  RestStateOf<T> state;
  state.stretch = lam_end;
  state.curvature.template head<2>() = integral * T(1.0 / load_stepping::forcePerElongation(section_, e));
  state.c = section_.complianceDensity(lam_end);
  return state;
}

// With t the share of the pressures: d ln lam = F dt / (E_t A + t F_b), du = (E_t I + t S_b)^-1 T(1) / sqrt(lam) dt, by
// Gauss-Legendre collocation of ln lam (order 12), its nodes by fixed point.
template <class T>
RestStateOf<T> LoadStepperOf<T>::continuousMaterialSteps(const Actuation& on) const {
  using std::abs, std::exp, std::sqrt;
  constexpr int kPanels = 4, kNodes = 6, kMostPasses = 60;
  constexpr int kPassesMore = 2;  // after the values have settled, for derivatives, which lag behind
  const GaussLegendre& table = gaussLegendre(kNodes);
  T log_stretch(0.0);
  Vector2Of<T> curvature = Vector2Of<T>::Constant(T(0.0));
  for (int panel = 0; panel < kPanels; ++panel) {
    T stretch[kNodes], rate[kNodes];
    for (T& at : stretch) at = exp(log_stretch);
    int settled = -1;
    for (int pass = 0; pass < kMostPasses && (settled < 0 || pass <= settled + kPassesMore); ++pass) {
      for (int i = 0; i < kNodes; ++i) {
        const ChamberStiffnessOf<T> pressurised = on.share((panel + table.c[i]) / kPanels);
        const T stiffness = section_.axialStiffness(stretch[i], pressurised);
        if (!(stretch[i] > 0.0 && section_.area(stretch[i]) > 0.0 && stiffness > 0.0))
          return load_stepping::outOfRange(stretch[i]);
        rate[i] = on.force / (static_cast<double>(kPanels) * stiffness);
      }
      bool moved = false;
      for (int i = 0; i < kNodes; ++i) {
        T at = log_stretch;
        for (int j = 0; j < kNodes; ++j) at += table.a[j][i] * rate[j];
        const T next = exp(at);
        moved = moved || !(abs(next - stretch[i]) < 1e-15 * next);
        stretch[i] = next;
      }
      if (!moved && settled < 0) settled = pass;
    }
    for (int i = 0; i < kNodes; ++i) {
      const ChamberStiffnessOf<T> pressurised = on.share((panel + table.c[i]) / kPanels);
      if (!section_.isValidAt(stretch[i], pressurised)) return load_stepping::outOfRange(stretch[i]);
      const Matrix2Of<T> softness = SectionMomentsOf<T>::inverse(section_.bendingStiffness(stretch[i], pressurised));
      curvature += (softness * on.moment) * T(table.b[i] / (static_cast<double>(kPanels) * sqrt(stretch[i])));
      log_stretch += table.b[i] * rate[i];
    }
  }
  RestStateOf<T> state;
  state.stretch = exp(log_stretch);
  if (!section_.isValidAt(state.stretch, on.stiffness)) return load_stepping::outOfRange(state.stretch);
  state.curvature.template head<2>() = curvature;
  state.c = section_.complianceDensity(state.stretch, on.stiffness);
  return state;
}

template <class T>
RestStateOf<T> LoadStepperOf<T>::restState(PressuresRefOf<T> pressures, Stepping stepping, int steps) const {
  const Actuation on = actuation(pressures);
  const bool plain = section_.isPlain();
  switch (stepping) {
    case Stepping::kFixedStep: return plain ? fixedSteps(on, steps) : fixedMaterialSteps(on, steps);
    case Stepping::kContinuous: return plain ? continuousSteps(on) : continuousMaterialSteps(on);
    case Stepping::kLinear: return linearStep(on);
  }
  return load_stepping::outOfRange(T(1.0));
}

}  // namespace live_stiffness
