#include "live_stiffness/section/chambers.h"

#include <cmath>

namespace live_stiffness {

Vector3 Chambers::centre(int k, double stretch) const {
  const double r = pitch_radius / std::sqrt(stretch);
  return {r * std::cos(azimuths[k]), r * std::sin(azimuths[k]), 0.0};
}

double Chambers::actuationForce(PressuresRef pressures) const { return area() * pressures.sum(); }

Vector3 Chambers::actuationMoment(PressuresRef pressures, double stretch) const {
  Vector3 moment = Vector3::Zero();
  for (int k = 0; k < count(); ++k) {
    const Vector3 d = centre(k, stretch);
    moment += pressures[k] * area() * Vector3(d.y(), -d.x(), 0.0);  // d x e3
  }
  return moment;
}

}  // namespace live_stiffness
