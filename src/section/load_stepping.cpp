#include "section/load_stepping_code.h"

namespace live_stiffness {

template class LoadStepperOf<double>;

int stepCount(double largest_pressure, double pressure_step) {
  const double steps = std::ceil(largest_pressure / pressure_step - 1e-9);
  return std::max(1, static_cast<int>(steps));
}

RestState restState(const CrossSection& section, PressuresRef pressures, Stepping stepping, int steps) {
  return LoadStepper(section).restState(pressures, stepping, steps);
}

}  // namespace live_stiffness
