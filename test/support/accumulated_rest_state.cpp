#include "support/accumulated_rest_state.h"

#include <cmath>

namespace live_stiffness {

AccumulatedRestState::AccumulatedRestState(const CrossSection& section)
    : section_(section), moments_(section) {
  reset();
}

void AccumulatedRestState::reset() {
  state_ = RestState();
  state_.c = moments_.complianceDensity(1.0);
  force_ = 0.0;
  moment_.setZero();
}

bool AccumulatedRestState::advanceTo(PressuresRef pressures) {
  if (pressures.size() != section_.chambers.count() || !pressures.allFinite()) return false;
  const double force = section_.chambers.actuationForce(pressures);
  const Vector3 moment = section_.chambers.actuationMoment(pressures, 1.0);
  const double stretch = state_.stretch * (1.0 + state_.c.shear_elongation(2, 2) * (force - force_));
  const ChamberStiffness pressurised = chamberStiffness(section_, pressures);
  if (!moments_.isValidAt(stretch, pressurised)) return false;
  state_.curvature += state_.c.bending_torsion * (moment - moment_) / std::sqrt(state_.stretch);
  state_.stretch = stretch;
  state_.c = moments_.complianceDensity(stretch, pressurised);
  force_ = force;
  moment_ = moment;
  return true;
}

}  // namespace live_stiffness
