#pragma once
// One shot along the chain: from a base moment to the moment left over at T, and how that depends on the base moment.

#include "live_stiffness/rod/backbone.h"

namespace live_stiffness {

// Force at the base of the chain, everything beyond it: tip force and all weights, N, base axes.
Vector3 baseForce(const Scene& scene, const DeadLoads& loads);

// Weight per stretched length of a segment, N/m, base axes.
Vector3 lineLoad(const Segment& segment, const RestState& rest, const DeadLoads& loads);

// Integrates backbone.elements (as many as element_count says) from the base to T under a base moment (N m, base
// axes). residual: moment at T that nothing balances, N m. nodes_hold_guess: the elements hold a solution nearby.
// False if an element does not converge or the residual is not finite; the nodes then hold no guess.
bool shoot(const Scene& scene, const DeadLoads& loads, const Vector3& base_moment, bool nodes_hold_guess,
           Backbone& backbone, Vector3& residual);

// Derivatives of the state at T with respect to [base moment, tip force] (columns), after a shot. Their .m is that of
// the residual.
StateColumns tipColumns(const Scene& scene, const DeadLoads& loads, const Backbone& backbone);

}  // namespace live_stiffness
