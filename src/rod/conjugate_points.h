#pragma once
// Stability of the inside of a robot, which the compliance of its tip does not see: a rod that holds a loop answers a
// push at its tip as a stable one does, and yet the loop would fall out.
//
// For dead loads n(s) is fixed, so the second variation is one of the rotations phi(s) alone (Jacobi). The equilibrium
// is stable if and only if the tip's compliance is positive definite *and* no section s between base and tip is
// conjugate to the base: det Phi(s) != 0, with Phi = d phi(s) / d m0 the rotations by a change of the base moment. Phi
// may have a double zero, of a symmetric column; so not its sign is followed but Phi_{i+1} Phi_i^-1 from element to
// element: b^-1 Phi_{i+1} Phi_i^-1, with b > 0 the element's own compliance, is the symmetric stiffness of their joint
// when the far end is held, and has a negative eigenvalue for each conjugate point between.

#include "rod/backbone.h"

namespace live_stiffness {

// True if the end of an element, with columns from tipColumns(), is conjugate to the base, or a section before it.
// Elements must be short enough to be stable with both ends held, as those that converge are. Exact without a dead tip
// moment, which has no potential.
bool hasConjugatePoint(const Backbone& backbone);

}  // namespace live_stiffness
