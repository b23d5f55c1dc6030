#pragma once
// What tests read from a TipContact.

#include <cmath>

#include "live_stiffness/TipContact.h"
#include "live_stiffness/conventions.h"
#include "support/estimate_checks.h"

namespace live_stiffness {

inline Vector3 vectorFrom(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

// Translational block of its compliance, m/N.
inline Matrix3 translationalCompliance(const TipContact& message) {
  Matrix3 C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C(i, j) = message.compliance[6 * i + j];
  return 0.5 * (C + C.transpose());
}

inline bool isFinite(const TipContact& message) {
  bool finite = positionOf(message.tip_pose).allFinite() && vectorFrom(message.wrench.force).allFinite() &&
                vectorFrom(message.wrench.torque).allFinite() && std::isfinite(message.stiffness_scale) &&
                std::isfinite(message.stiffness_scale_deviation) && std::isfinite(message.innovation);
  for (const auto* values : {&message.covariance, &message.compliance})
    for (double value : *values) finite = finite && std::isfinite(value);
  return finite;
}

}  // namespace live_stiffness
