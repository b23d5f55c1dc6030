#pragma once
// Uncertainty of a calibration's parameters and registrations, from the Jacobian at the solution.

#include "calibration/calibration_problem.h"

namespace live_stiffness {

// Sets parameters (values, standard errors with and without priors), correlation, undetermined directions and, of each
// recording, whether its registration is determined. use_priors: the solution was found with them. result.scene must be there.
void describeParameters(const CalibrationProblem& problem, const std::vector<SceneParameter>& parameters,
                        const CalibrationProblem::Solution& solution, size_t recordings, bool use_priors,
                        CalibrationResult& result);

}  // namespace live_stiffness
