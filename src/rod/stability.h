#pragma once
// Whether an equilibrium under dead loads is stable, as far as its tip and its loads tell; conjugate_points.h looks inside.

#include "rod/backbone.h"

namespace live_stiffness {

// An upper bound of the ratio of load and buckling load of the straight robot, for the rest states in the backbone;
// dimensionless. For a tip load on a uniform column 1.007 times the ratio itself, for its own weight less than 1.02 times;
// exact for a soft hinge. A tip moment alone winds the rod up by half a turn before it has a choice. In a plane there is one
// equilibrium only below 1 (docs/derivation.md, section 4). NaN for loads that are not numbers.
double loadNumber(const Chain& chain, const DeadLoads& loads, const Backbone& backbone);

// The tangent compliance C of the tip is positive definite, and clearly so: not neutral. softness: rotation of the softest
// segment by a unit moment, rad/(N m); error: relative, of C apart from its growth towards buckling.
bool isTipStable(const Matrix6& C, double softness, double error);
// The same of its angular block alone, rad/(N m). Where stability is lost shows there, too: the motion by which a rod gives
// way under dead loads turns its tip, because at the tip its moment does not change, and if the tip did not turn either,
// nothing before it would (the linearised rod is a first-order equation in both).
bool isTipTurningStable(const Matrix3& C, double softness, double error);

}  // namespace live_stiffness
