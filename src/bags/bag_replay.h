#pragma once
// Runs what the node runs on a recorded bag, offline and as fast as possible: estimates in a new bag, and a report.

#include <functional>
#include <string>
#include <vector>

#include "bags/bag_reader.h"
#include "live_stiffness/estimation/error_summary.h"
#include "ros/node_parameters.h"

namespace live_stiffness {

// Statistics of a topic.
struct TopicReport {
  std::string name;
  long accepted = 0, rejected = 0, out_of_order = 0;
  double rate = 0.0;         // of accepted ones without the longest gap, Hz; 0: fewer than three
  double longest_gap = 0.0;  // s
  double gap_start = 0.0;    // from the bag's begin, s
};

struct ReplayReport {
  double duration = 0.0;  // of the bag, s
  TopicReport pressures, poses, wrenches;
  std::vector<std::string> warnings;  // about messages and what they hold
  long estimates = 0, stale_estimates = 0;  // that were put out
  long updates = 0, failures = 0;   // solves that gave an estimate, and that did not
  std::string first_failure;
  double update_median = 0.0, update_p99 = 0.0;        // time of a solve, s
  double numerical_error_median = 0.0, numerical_error_max = 0.0;  // estimated, relative
  ErrorSummary tracking_error;      // measured tip against the newest estimate, m
  long contacts = 0, in_contact = 0;  // estimates of the external wrench, and those in contact
  double wall_time = 0.0;           // duration of the replay, s

  // As Markdown.
  std::string text(const std::string& bag, const NodeParameters& parameters) const;
};

// Plays the bags as one and writes to `out` what the node would have published on /stiffness_node/estimate, tip_pose,
// tracking_error, tip_contact and tip_wrench_estimate. progress: gets the number of messages done and their total. Throws as
// playBags() does when a bag cannot be read, and ConfigurationError when `out` cannot be written or is one of the bags, or when
// there are no usable pressures; then there is no file with the name `out`.
ReplayReport replayBags(const std::vector<std::string>& bags, const std::string& out, const NodeParameters& parameters,
                        const BagTopics& topics, const std::function<void(long, long)>& progress = {});

}  // namespace live_stiffness
