#pragma once
// A scene prepared for solving: what a solve needs to know of each body, computed once.

#include <vector>

#include "rod/chain_state.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

struct Chain {
  using Part = ChainPart;

  std::vector<Part> parts;  // base to tip
  double mass = 0.0;        // of everything, kg
  double tip_mass = 0.0;
  Vector3 tip_offset = Vector3::Zero();

  explicit Chain(const Scene& scene);
};

// Dead loads on a scene: gravity on every mass and a wrench at T (base axes).
struct DeadLoads {
  Vector3 gravity = Vector3::Zero();  // m/s^2
  Wrench tip = Wrench::Zero();        // [f; m], N and N m

  DeadLoads scaled(double factor) const { return {factor * gravity, factor * tip}; }

  // Force at the base of the chain: the sum of tip force and all weights, N, base axes.
  Vector3 baseForce(const Chain& chain) const { return linear(tip) + chain.mass * gravity; }
};

}  // namespace live_stiffness
