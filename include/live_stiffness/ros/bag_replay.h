#pragma once
// A recorded bag through the estimator, offline and as fast as it goes: estimates to a new bag, and a report.

#include <functional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/error_summary.h"
#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "live_stiffness/ros/conversions.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

// What the node has as parameters. Topics with or without a leading slash.
struct ReplayOptions {
  std::string pressure_topic = "chamber_pressures", pose_topic = "aurora_pose", wrench_topic = "tip_wrench";
  PressureFormat pressure_format;
  double position_unit = 1.0;           // m per unit of the tracker's positions
  std::vector<int> channel_of_chamber;  // empty: the channels of the first message feed neighbours evenly
  Registration registration;
  FrameNames frames{"base", "tip"};
  EstimatorOptions estimator;
  double heartbeat = 1.0;  // Hz: an estimate at least so often while there are pressures
};

// How well a topic kept time.
struct TopicReport {
  std::string name;
  long usable = 0, unusable = 0;
  long backward = 0;         // usable ones stamped before the one before
  std::string first_fault;   // of the unusable ones
  double rate = 0.0;         // usable ones in the median interval, Hz; 0: fewer than two
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
  double wall_time = 0.0;           // that the replay took, s

  // As Markdown, for people.
  std::string text(const std::string& bag, double accuracy) const;
};

// Reads `bag` in the order of recording and writes to `out` what the node would have published on
// /stiffness_node/estimate, /tip_pose and /tracking_error. `progress` is told messages done and in all. Messages that
// cannot be used are counted and left out. Throws ConfigurationError when a bag cannot be read or written, is the same as
// the other, the scene or options are bad, or no usable pressures are in it; then no file is left under the name of `out`.
ReplayReport replayBag(const std::string& bag, const std::string& out, const Scene& scene, const ModelOptions& model,
                       const ReplayOptions& options, const std::function<void(long, long)>& progress = {});

}  // namespace live_stiffness
