#pragma once
// The choice of samples by name.

#include <string>

#include "calibration/calibration.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {

// all or quasi_static; adds a fault for any other name.
inline SampleChoice sampleChoice(const std::string& name, FaultList& faults) {
  if (name != "all" && name != "quasi_static") faults.add("samples '" + name + "': must be all or quasi_static");
  return name == "all" ? SampleChoice::kAll : SampleChoice::kQuasiStatic;
}

}  // namespace live_stiffness
