#pragma once
// Runs the estimator on a recorded bag, offline and as fast as possible: estimates in a new bag, and a report.

#include <functional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/error_summary.h"
#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "bags/bag_reader.h"

namespace live_stiffness {

// Options that are parameters of the node.
struct ReplayOptions {
  BagFormat format{"chamber_pressures", "aurora_pose", "tip_wrench", {}, kPositionUnit.standard};
  std::vector<int> channel_of_chamber;  // empty: even groups, see ChannelMap::even()
  Registration registration;
  FrameNames frames{"base", "tip"};
  EstimatorOptions estimator;
  double heartbeat = 1.0;  // Hz: at least this rate of estimates while there are pressures
};

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

// Reads `bag` in the order of recording and writes to `out` what the node would have published on
// /stiffness_node/estimate, /tip_pose and /tracking_error. `progress` gets the number of messages done and
// their total. Messages that cannot be used are counted and left out. Throws as readBag() does when `bag` cannot be read, and
// ConfigurationError when `out` cannot be written or is the same bag, when scene or options are bad, or when there are no
// usable pressures; then there is no file with the name `out`.
ReplayReport replayBag(const std::string& bag, const std::string& out, const Scene& scene, const ModelOptions& model,
                       const ReplayOptions& options, const std::function<void(long, long)>& progress = {});

}  // namespace live_stiffness
