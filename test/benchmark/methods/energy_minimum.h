#pragma once
// The equilibrium as minimum of the potential energy over the rotations of many sections (support/chain_energy.h): Newton's
// method downhill, at full load, with a block-tridiagonal Hessian that is shifted where it is not positive, and the step length
// by the energy. Of second order in the distance of the sections; nothing is extrapolated.

#include "benchmark/methods/loaded_chain.h"
#include "benchmark/methods/stiffness_method.h"
#include "support/chain_energy.h"

namespace live_stiffness {

class EnergyMinimum : public StiffnessMethod {
 public:
  // intervals: of each segment.
  EnergyMinimum(const Scene& scene, int intervals);

  // Sets status, pose and tangent compliance.
  StiffnessSolution solve(PressuresRef pressures) override;
  void reset() override { nodes_.clear(); }

 private:
  Scene scene_;
  LoadedChain chain_;
  int intervals_;
  NodeRotations nodes_;  // of the last solve; empty: cold
};

}  // namespace live_stiffness
