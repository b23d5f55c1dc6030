#pragma once
// How a segment's section is updated while the pressures grow, (2.3).

namespace live_stiffness {

enum class Stepping {
  kFixedStep,   // (12): n equal steps along the straight path from zero pressure; the paper's NPCC and NCM
  kContinuous,  // limit n -> infinity, by quadrature: no step-size dependence
  kLinear,      // one step, the section never updated; the paper's LPCC and LCM
};

}  // namespace live_stiffness
