#pragma once
// dynamic_reconfigure of a running stiffness_node; cfg/Stiffness.cfg says of what.

#include <live_stiffness/StiffnessConfig.h>

#include "ros/node_parameters.h"

namespace live_stiffness {

// Levels in cfg/Stiffness.cfg.
enum Reconfigured : uint32_t { kDisplayChanged = 1, kContactChanged = 2, kRobotChanged = 4 };

// Takes it over into the parameters. What does not fit together is a fault, and then the parameters are not to be used.
void apply(const StiffnessConfig& config, NodeParameters& parameters, FaultList& faults);

}  // namespace live_stiffness
