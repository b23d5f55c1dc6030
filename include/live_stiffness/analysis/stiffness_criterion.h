#pragma once
// One number for the stiffness of a configuration: the tau of the augmented position p_w = [x, y, z, tau] (22).

#include <string>

#include "live_stiffness/checks.h"
#include "live_stiffness/conventions.h"

namespace live_stiffness {

enum class CriterionKind {
  kLargestEigenstiffness,   // largest positive eigenvalue of K Delta, N; the tau of Fig. 10 (a)
  kSmallestEigenstiffness,  // smallest positive one, N
  kTrace,                   // of the translational block of K, N/m: constrained stiffness summed over three axes
  kLargestStiffness,        // free stiffness along the stiffest direction, 1 / smallest eigenvalue of C_fv, N/m
  kSmallestStiffness,       // the same along the softest direction, N/m
  kDirectional,             // free stiffness along a direction through the tip, 1 / (d^T C_fv d), N/m
  kConstrained,             // constrained stiffness along a direction, d^T K_fv d, N/m
};

struct StiffnessCriterion {
  CriterionKind kind = CriterionKind::kLargestEigenstiffness;
  Vector3 direction = Vector3::UnitX();  // of kDirectional and kConstrained, base axes, not zero

  // tau from the compliance of T, base axes. NaN unless C is positive definite, as that of a stable equilibrium is.
  double operator()(const Matrix6& C) const;
  std::string name() const;  // as criterionNamed() takes it
  const char* unit() const;  // "N" or "N/m"
};

// largest_eigenstiffness, smallest_eigenstiffness, trace, largest_stiffness, smallest_stiffness, directional:D or
// constrained:D, with D x, y, z or dx,dy,dz (base axes). Anything else becomes a fault.
StiffnessCriterion criterionNamed(const std::string& text, FaultList& faults);

// A direction as x, y, z, optionally with a sign, or dx,dy,dz; `name` is for the fault. Unit vector.
Vector3 directionNamed(const std::string& name, const std::string& text, FaultList& faults);

}  // namespace live_stiffness
