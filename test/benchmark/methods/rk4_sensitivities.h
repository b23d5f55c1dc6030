#pragma once
// RK4 on rotation matrices with the variational equations carried along: no finite differences.

#include "benchmark/methods/base_moment_shooting.h"
#include "benchmark/methods/rk4.h"

namespace live_stiffness {

class Rk4Sensitivities : public BaseMomentShooting {
 public:
  // steps: of each segment, even.
  Rk4Sensitivities(const Scene& scene, int steps);

 private:
  bool integrate(int index, const SoftPiece& piece, RodState& state) override;
  bool integrate(int index, const SoftPiece& piece, RodState& state, RodColumns& columns, MaterialSum& sum) override;

  int steps_;
};

}  // namespace live_stiffness
