#include "section/load_stepping_code.h"

namespace live_stiffness {

template class LoadStepperOf<double>;

int stepCount(double largest_pressure, double pressure_step) {
  const double steps = largest_pressure / pressure_step - 1e-9;
  const int whole = static_cast<int>(steps);  // std::ceil is a call where SSE4.1 is not taken for granted
  return std::max(1, whole + (steps > whole));
}

}  // namespace live_stiffness
