#pragma once
// Stability of an equilibrium under dead loads, as far as its loads and the compliance of its tip can show it. For the
// sections between base and tip see conjugate_points.h.

#include "rod/backbone.h"

namespace live_stiffness {

// Normalised load: an upper bound of the load divided by the buckling load of the straight robot, for the rest states in
// the backbone; dimensionless. It is 1.007 times that ratio for a tip load on a uniform column, less than 1.02 times for the
// column's own weight, and exact for one flexible hinge. A tip moment does not count: alone it can bend the rod by half a
// turn before there is a second equilibrium. Below 1 there is only one equilibrium in a plane (docs/derivation.md, section
// 4). NaN if a load is NaN.
double normalisedLoad(const Chain& chain, const DeadLoads& loads, const Backbone& backbone);

// True if the tangent compliance C of the tip is positive definite with a margin, so that the equilibrium is not neutral
// either. bending_compliance: rotation of the most compliant segment by a unit moment, rad/(N m); error: relative error of C
// without its growth towards buckling.
bool isTipStable(const Matrix6& C, double bending_compliance, double error);
// The same for the angular block alone, rad/(N m), which also shows a loss of stability: the buckling motion of a rod under
// dead loads turns its tip. At the tip the moment does not change; if the tip did not turn either, nothing would move (the
// linearised rod is a first-order equation in rotation and moment).
bool isTipTurningStable(const Matrix3& C, double bending_compliance, double error);

}  // namespace live_stiffness
