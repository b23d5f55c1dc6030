#include "live_stiffness/estimation/tip_wrench_options.h"

namespace live_stiffness {

void TipWrenchOptions::checkComponents(FaultList& faults) const {
  if (components == 4 || components == 5)
    faults.add(kWrenchComponents.key + (" = " + std::to_string(components)) + ": must be 3 (force) or 6 (force and moment)");
}

}  // namespace live_stiffness
