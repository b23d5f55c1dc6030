#pragma once
// A recorded bag through the estimator, offline and as fast as it goes: estimates to a new bag, and a report.

#include <functional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "bags/bag_format.h"
#include "bags/replay_report.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

// What the node has as parameters.
struct ReplayOptions {
  BagFormat format{"chamber_pressures", "aurora_pose", "tip_wrench", {}, 1.0};
  std::vector<int> channel_of_chamber;  // empty: the channels of the first message feed neighbours evenly
  Registration registration;
  FrameNames frames{"base", "tip"};
  EstimatorOptions estimator;
  double heartbeat = 1.0;  // Hz: an estimate at least so often while there are pressures
};

// Reads `bag` in the order of recording and writes to `out` what the node would have published on
// /stiffness_node/estimate, /tip_pose and /tracking_error. `progress` is told messages done and in all. Messages that
// cannot be used are counted and left out. Throws as readBag() does when `bag` cannot be read, and ConfigurationError when
// `out` cannot be written or is the same bag, the scene or options are bad, or no usable pressures are in it; then no file
// is left under the name of `out`.
ReplayReport replayBag(const std::string& bag, const std::string& out, const Scene& scene, const ModelOptions& model,
                       const ReplayOptions& options, const std::function<void(long, long)>& progress = {});

}  // namespace live_stiffness
