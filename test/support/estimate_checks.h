#pragma once
// Reading StiffnessEstimate messages back, and the promise that no field is ever NaN.

#include <Eigen/Core>
#include <cmath>

#include "live_stiffness/StiffnessEstimate.h"
#include "live_stiffness/conventions.h"

namespace live_stiffness {

template <class Array>
Matrix6 matrixFrom(const Array& values) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(values.data());
}

inline Vector3 positionOf(const geometry_msgs::Pose& pose) { return {pose.position.x, pose.position.y, pose.position.z}; }

inline bool isFinite(const StiffnessEstimate& message) {
  bool finite = positionOf(message.tip_pose).allFinite() && std::isfinite(message.tip_pose.orientation.w);
  for (const auto* values : {&message.compliance, &message.material_compliance, &message.stiffness})
    for (double value : *values) finite = finite && std::isfinite(value);
  for (double value : message.pressure) finite = finite && std::isfinite(value);
  for (double value : message.compliance_eigenvalues) finite = finite && std::isfinite(value);
  return finite && std::isfinite(message.numerical_error) && std::isfinite(message.solve_time);
}

}  // namespace live_stiffness
