#pragma once
// Residuals of a calibration's samples.

#include <memory>

#include "calibration/recording_evaluator.h"

namespace ceres {
class CostFunction;
}

namespace live_stiffness {

struct ResidualSigmas {
  double position, rotation;  // m, rad; rotation 0: orientations are not used
};

// One sample: position and, with a rotation sigma, orientation of the sensor in the tracker's frame, in sigmas. Blocks:
// the parameters, unless there are none, and the recording's registration. Refers to evaluator and parameters.
std::unique_ptr<ceres::CostFunction> sampleCost(RecordingEvaluator& evaluator, size_t sample,
                                                const std::vector<SceneParameter>& parameters,
                                                const ResidualSigmas& sigmas);

}  // namespace live_stiffness
