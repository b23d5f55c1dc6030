#pragma once
// Parameters of the estimate of the tip wrench. config/stiffness_node.yaml is their manual.

#include <string>
#include <vector>

#include "live_stiffness/estimation/tip_wrench_options.h"
#include "ros/parameter_reader.h"

namespace live_stiffness {

// One of them: its value in SI is `factor` times the parameter.
struct ContactParameter {
  std::string key;
  double* value;
  Range range;                    // of the parameter
  double factor = 1.0;
  const double* low = nullptr;    // the lower end of the range instead, SI; nullptr: as in range
  const double* high = nullptr;   // the upper end
};

// All numbers among the options, which must outlive the result.
std::vector<ContactParameter> contactParameters(TipWrenchOptions& options);

TipWrenchOptions readContactParameters(ParameterReader& read, FaultList& faults);

}  // namespace live_stiffness
