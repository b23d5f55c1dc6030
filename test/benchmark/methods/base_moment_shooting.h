#pragma once
// Shooting on the base moment alone (three unknowns: for dead loads n(s) is known) with derivatives carried along; what
// the opponents with analytic sensitivities share. They differ in how they integrate a soft piece.

#include "benchmark/methods/loaded_chain.h"
#include "benchmark/methods/material_sum.h"
#include "benchmark/methods/stiffness_method.h"

namespace live_stiffness {

class BaseMomentShooting : public StiffnessMethod {
 public:
  BaseMomentShooting(std::string name, const Scene& scene);

  StiffnessSolution solve(PressuresRef pressures) final;
  void reset() final { warm_ = false; }

 protected:
  // Integrates the state over soft piece number `index`. False if that fails.
  virtual bool integrate(int index, const SoftPiece& piece, RodState& state) = 0;
  // The same, and the columns, and the material compliance.
  virtual bool integrate(int index, const SoftPiece& piece, RodState& state, RodColumns& columns, MaterialSum& sum) = 0;
  // Called before a cold start: drops what integrate() keeps as its next guess.
  virtual void forget() {}

  const LoadedChain& chain() const { return chain_; }

 private:
  struct Tip {
    RodState state;
    RodColumns columns;
    MaterialSum sum;
  };
  bool shoot(RodState& tip);
  bool shootWithColumns(Tip& tip);
  bool newton(bool fresh_jacobians);
  StiffnessSolution finish();

  LoadedChain chain_;
  Vector3 base_moment_ = Vector3::Zero();
  Matrix3 inverse_ = Matrix3::Zero();  // base moment per residual moment
  bool warm_ = false;
};

}  // namespace live_stiffness
