#include "live_stiffness/estimation/tracker_measures.h"

#include <Eigen/Geometry>

#include "live_stiffness/parameters.h"

namespace live_stiffness {
namespace {

constexpr TrackerMeasures kAll[] = {TrackerMeasures::kPose, TrackerMeasures::kPosition, TrackerMeasures::kPositionAndAxis};

}  // namespace

TrackerMeasures trackerMeasuresNamed(const std::string& name) {
  for (TrackerMeasures measures : kAll)
    if (trackerMeasuresName(measures) == name) return measures;
  return TrackerMeasures::kPose;
}

std::string trackerMeasuresName(TrackerMeasures measures) {
  return kTrackerMeasures.choices[1 + static_cast<size_t>(measures)];  // the first is empty: to be found out
}

Pose completedPose(const Pose& X_AS, const Pose& expected, TrackerMeasures measures) {
  if (measures == TrackerMeasures::kPose) return X_AS;
  if (measures == TrackerMeasures::kPosition) return {expected.R, X_AS.p};
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(expected.R.col(2), X_AS.R.col(2));
  return {turn.toRotationMatrix() * expected.R, X_AS.p};
}

}  // namespace live_stiffness
