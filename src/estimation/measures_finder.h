#pragma once
// Finds from its poses what a tracker measures, where they leave no doubt.

#include <optional>
#include <vector>

#include "live_stiffness/estimation/tracker_measures.h"

namespace live_stiffness {

class MeasuresFinder {
 public:
  // A new pose of the sensor, different from the last one.
  void add(const Pose& X_AS);
  // kPosition: the orientation stands still while the sensor moves, or jumps about while it hardly moves. kPositionAndAxis: only
  // the turn about the sensor's z axis jumps about. None: a pose as far as this shows.
  std::optional<TrackerMeasures> found() const { return found_; }

 private:
  std::optional<TrackerMeasures> judge() const;

  Pose first_, last_;
  double largest_turn_ = 0.0;      // from the first orientation, rad
  double farthest_ = 0.0;          // from the first position, m
  std::vector<double> moves_, tilts_, rolls_;  // from pose to pose: of the position, m; of the z axis and about it, rad
  long count_ = 0;
  std::optional<TrackerMeasures> found_;
};

}  // namespace live_stiffness
