#pragma once
// Stability between base and tip, which the compliance of the tip does not show: a rod with a loop in it may react to a
// push at its tip as a stable one does, although the loop would open.
//
// For dead loads n(s) is fixed, so the second variation depends on the rotations phi(s) only (Jacobi). The equilibrium is
// stable if and only if the tip's compliance is positive definite *and* no section s between base and tip is conjugate to
// the base: det Phi(s) != 0, where Phi = d phi(s) / d m0 are the rotations by a change of the base moment. The sign of det
// Phi is not enough, because a symmetric column has a double zero. So Phi_{i+1} Phi_i^-1 is examined from element to
// element: b^-1 Phi_{i+1} Phi_i^-1, with b > 0 the element's own compliance, is the symmetric stiffness of the joint before
// the element when its far end is clamped. It has one negative eigenvalue for each conjugate point in the element.

#include "rod/backbone.h"

namespace live_stiffness {

// Number of conjugate points from the base to the tip, with multiplicity. The elements need the sensitivities of
// tipSensitivities(), and must be short enough to be stable with both ends clamped; all that converge are. Exact without a dead
// tip moment, which has no potential.
int conjugatePoints(const Backbone& backbone);

// Number of eigenvalues of G that are not positive; G must have three real ones. 3 if G is not finite.
int negativeEigenvalues(const Matrix3& G);

}  // namespace live_stiffness
