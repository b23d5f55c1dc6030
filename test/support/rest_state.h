#pragma once
// Load stepping of one segment in one call.

#include "section/load_stepping.h"

namespace live_stiffness {

inline RestState restState(const CrossSection& section, PressuresRef pressures, Stepping stepping, int steps) {
  return LoadStepper(section).restState(pressures, stepping, steps);
}

}  // namespace live_stiffness
