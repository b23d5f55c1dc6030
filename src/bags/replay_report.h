#pragma once
// Statistics of a replayed bag.

#include <string>

#include "live_stiffness/estimation/error_summary.h"

namespace live_stiffness {

// Statistics of a topic.
struct TopicReport {
  std::string name;
  long usable = 0, unusable = 0;
  long backward = 0;         // usable ones whose stamp is before the previous one
  std::string first_fault;   // of the unusable ones
  double rate = 0.0;         // inverse of the median interval between usable ones, Hz; 0: fewer than two
  double longest_gap = 0.0;  // s
  double gap_start = 0.0;    // from the bag's begin, s
};

struct ReplayReport {
  double duration = 0.0;  // of the bag, s
  TopicReport pressures, poses, wrenches;
  long updates = 0, failures = 0;   // solves that gave an estimate, and that did not
  std::string first_failure;
  double update_median = 0.0, update_p99 = 0.0;        // time of a solve, s
  double numerical_error_median = 0.0, numerical_error_max = 0.0;  // estimated, relative
  ErrorSummary tracking_error;      // measured tip against the newest estimate, m
  double wall_time = 0.0;           // duration of the replay, s

  // As Markdown.
  std::string text(const std::string& bag, double accuracy) const;
};

}  // namespace live_stiffness
