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

// Compliance that one element adds about the point p_B (m, base axes).
Matrix6 elementCompliance(const RestState& rest, const RodElement& element, const Vector3& p_B);

// Material compliance of the whole chain about T, base axes.
Matrix6 tipMaterialCompliance(const Backbone& backbone);

// Station at `fraction` (0 to 1) of a segment's length. loaded: the backbone comes from statics.
Station stationAt(const Backbone& backbone, int segment, double fraction, bool loaded);

}  // namespace live_stiffness
