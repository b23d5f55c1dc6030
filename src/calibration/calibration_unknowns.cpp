#include "calibration/calibration_unknowns.h"

#include <algorithm>

namespace live_stiffness {

Eigen::VectorXd valuesAt(const std::vector<SceneParameter>& parameters, const double* x) {
  Eigen::VectorXd values(static_cast<long>(parameters.size()));
  for (size_t k = 0; k < parameters.size(); ++k)
    values[static_cast<long>(k)] =  // rounding must not make a mass of zero negative
        std::clamp(parameters[k].start + parameters[k].prior_sigma * x[k], parameters[k].low, parameters[k].high);
  return values;
}

}  // namespace live_stiffness
