#pragma once
// The balance that any equilibrium must keep, whatever found it.

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

// Moment about the base of every weight and of the tip wrench (N m, base axes), on the shape of the last solve in
// `workspace`, by Gauss quadrature of order 10 over `panels` parts a segment: shares only the shape with the solver.
Vector3 momentOfLoads(const StiffnessModel& model, const StiffnessWorkspace& workspace, const Pose& X_BT,
                      const Wrench& tip, int panels = 12);

// Moment at the base that the last solve in `workspace` found, N m, base axes.
Vector3 baseMoment(const StiffnessModel& model, const StiffnessWorkspace& workspace, const Wrench& tip);

}  // namespace live_stiffness
