#pragma once
// How many equilibria dead loads allow, and which of them are neutral.

#include "rod/backbone.h"

namespace live_stiffness {

// Normalised load: an upper bound of the load divided by the buckling load of the straight robot, for the rest states in
// the backbone; dimensionless. It is 1.007 times that ratio for a tip load on a uniform column, less than 1.02 times for the
// column's own weight, and exact for one flexible hinge. A tip moment does not count: alone it can bend the rod by half a
// turn before there is a second equilibrium. Below 1 there is only one equilibrium in a plane (docs/derivation.md, section
// 4). NaN if a load is NaN.
double normalisedLoad(const Chain& chain, const DeadLoads& loads, const Backbone& backbone);

// True if the tip turns so much more under a moment than without loads (`growth` times) that no digit of that is left: at a
// neutral equilibrium the compliance is infinite but for rounding and the relative `error` of discretisation.
bool isNeutral(double growth, double error);

}  // namespace live_stiffness
