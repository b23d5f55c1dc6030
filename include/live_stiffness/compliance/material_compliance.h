#pragma once
// Material compliance of a solved backbone: the integral dC/ds = Ad^-T c Ad^-1 (10), summed over segments.
// Rigid links add nothing.

#include "live_stiffness/rod/backbone.h"

namespace live_stiffness {

// A section of the robot: its pose in B, stretch, and material compliance of everything between base and section,
// about the section's origin, in base axes (6x6, SI, linear first).
struct Station {
  Pose X_BS;
  double stretch = 1.0;
  Matrix6 compliance = Matrix6::Zero();
};

// tip_compliance: material compliance of the whole chain about T, base axes. Prepares the elements for stations of this
// accuracy. The shape must come from statics. Returns an estimate of the relative error that this adds to that of the
// shape.
double accumulateMaterial(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance);

// The same of a chain on which nothing external acts, with its shape: X_BT and elements, of which there must be enough
// (see StaticsSolver::prepareUnloaded()). In closed form where the section bends the same in all directions.
double placeUnloaded(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance);

// Stations at fractions (0 to 1, in any order; values beyond are moved to the ends) of a segment's length. Needs
// accumulateMaterial() or placeUnloaded(). Read from the collocation polynomials where these are accurate enough
// (relative), else integrated anew. Both arrays are of `size`.
void stationsAt(const Backbone& backbone, int segment, const double* fractions, size_t size, double accuracy,
                bool loaded, Station* out);

}  // namespace live_stiffness
