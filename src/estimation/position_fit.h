#pragma once
// The part of a registration that positions determine: where the base stands, and the sensor's offset. See fitRegistration().

#include <vector>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

struct PositionFit {
  Pose X_AB;
  Vector3 offset = Vector3::Zero();  // p_TS, m
  std::vector<double> residuals;     // |p_AS predicted - measured| per sample, m
  bool base_rotation_determined = false, sensor_offset_determined = false;
  double weakest_sensitivity = 0.0;  // these as in RegistrationFit
};

// start_from_orientations: try a start from the orientations, too, and take it unless it fits clearly worse. At least 3
// samples, all finite.
PositionFit fitPositions(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS, bool start_from_orientations);

// Rotation R with the largest trace(R^T M): polar factor of M, reflections excluded.
Matrix3 nearestRotation(const Matrix3& M);

}  // namespace live_stiffness
