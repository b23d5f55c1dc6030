#pragma once
// Runs the estimator on a recorded bag, offline and as fast as possible: estimates in a new bag, and a report.

#include <functional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "bags/bag_format.h"
#include "bags/replay_report.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

// Options that are parameters of the node.
struct ReplayOptions {
  BagFormat format{"chamber_pressures", "aurora_pose", "tip_wrench", {}, 1.0};
  std::vector<int> channel_of_chamber;  // empty: even groups, see ChannelMap::even()
  Registration registration;
  FrameNames frames{"base", "tip"};
  EstimatorOptions estimator;
  double heartbeat = 1.0;  // Hz: at least this rate of estimates while there are pressures
};

// Reads `bag` in the order of recording and writes to `out` what the node would have published on
// /stiffness_node/estimate, /tip_pose and /tracking_error. `progress` gets the number of messages done and
// their total. Messages that cannot be used are counted and left out. Throws as readBag() does when `bag` cannot be read, and
// ConfigurationError when `out` cannot be written or is the same bag, when scene or options are bad, or when there are no
// usable pressures; then there is no file with the name `out`.
ReplayReport replayBag(const std::string& bag, const std::string& out, const Scene& scene, const ModelOptions& model,
                       const ReplayOptions& options, const std::function<void(long, long)>& progress = {});

}  // namespace live_stiffness
