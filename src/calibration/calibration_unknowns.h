#pragma once
// What a calibration searches for.

#include <vector>

#include "calibration/scene_parameter.h"

namespace live_stiffness {

// Unknowns: x, the parameters minus their start, in units of their prior sigmas; and for each recording 12 numbers
//   [w_AB, p_AB, p_TS, w_TS], R_AB = exp(w_AB) R_AB_start, R_TS = exp(w_TS) R_TS_start; m and rad.
constexpr int kRegistrationSize = 12;
constexpr double kOffsetSigma = 0.03;  // prior of the sensor's offset from T, per axis, m: it is on the tip
using RegistrationVector = Eigen::Matrix<double, kRegistrationSize, 1>;

struct CalibrationUnknowns {
  Eigen::VectorXd x;
  std::vector<RegistrationVector> registrations;
};

// Values of the parameters (SI) at x, which has one entry for each; limited to their bounds.
Eigen::VectorXd valuesAt(const std::vector<SceneParameter>& parameters, const double* x);

}  // namespace live_stiffness
