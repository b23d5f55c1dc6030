#pragma once
// Elements of a chain: what acts on them, and walks from base to tip.

#include "rod/backbone.h"

namespace live_stiffness {

// Chain, loads and elements as plain data; the backbone's elements are what it refers to.
ChainState stateOf(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone);

// What a solve keeps of the solution from which it starts, so that the next solve can extrapolate the change.
enum class History {
  kNone,  // the nodes may still hold a guess for the same rest curvatures
  kShape,
  kSensitivities,  // both
};

// Sets lengths, sections and loads of the elements (element_count of them); once before the iterations. With a history the
// guess that they hold is moved along with the change of rest curvature. extrapolate: the same history of the same elements was
// kept by the last call, too; then shape, start values and sensitivities are extrapolated.
void prepare(const Chain& chain, const DeadLoads& loads, Backbone& backbone, History keep = History::kNone,
               bool extrapolate = false);

// Walks from base to tip with the given base moment; sets X_BT.
MarchResult march(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, MarchMode mode, Backbone& backbone);

// Iterates until the shape has converged to rounding. False if it does not converge or is not admissible; then the nodes hold
// no guess.
bool shoot(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, bool nodes_hold_guess,
           Backbone& backbone, Vector3& residual);

}  // namespace live_stiffness
