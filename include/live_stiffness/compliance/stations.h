#pragma once
// Stations: sections of a solved backbone, with their pose, stretch and compliance.

#include <memory>
#include <vector>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

// A section of the robot: its pose in B, stretch, and material compliance of everything between base and section,
// about the section's origin, in base axes (6x6, SI, linear first).
struct Station {
  Pose X_BQ;
  double stretch = 1.0;
  Matrix6 compliance = Matrix6::Zero();
};

class StationBatches;  // of the library, see src/compliance/station_reader.h

// Stations at fixed fractions of a segment, in any order; see StiffnessModel::stations(). It stores the element of each station
// and its interpolation weights, which are expensive to compute; so keep one plan for each segment.
class StationPlan {
 public:
  // 0 to 1; below 0, or NaN, is the segment's base, above 1 its end.
  explicit StationPlan(std::vector<double> fractions);
  StationPlan(const StationPlan& other);
  StationPlan(StationPlan&&) noexcept;
  ~StationPlan();

  int size() const;

 private:
  friend class StiffnessModel;
  std::unique_ptr<StationBatches> batches_;
};

}  // namespace live_stiffness
