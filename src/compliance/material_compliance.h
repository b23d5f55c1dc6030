#pragma once
// Material compliance of a solved backbone: the integral dC/ds = Ad^-T c Ad^-1 (10), summed over segments.
// Rigid links add nothing.

#include "rod/backbone.h"

namespace live_stiffness {

// tip_compliance: material compliance of the whole chain about T, base axes. Prepares the elements for stations of this
// accuracy. The shape must come from statics.
void accumulateMaterial(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance);

// The same of a chain on which nothing external acts, with its shape: X_BT and elements, of which there must be enough
// (see StaticsSolver::prepareUnloaded()). In closed form where the section bends the same in all directions. Returns an estimate
// of its relative error: 0, or at least 1 if an element bends too far.
double solveUnloaded(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance);

}  // namespace live_stiffness
