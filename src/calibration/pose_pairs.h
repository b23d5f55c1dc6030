#pragma once
// What the model predicts beside what a tracker measured, for judging the poses before anything is fitted to them.

#include <vector>

#include "calibration/calibration.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

// Predicted tips and measured poses of the samples of the fit that the tracker saw anew, as far as the model has a solution.
struct PosePairs {
  std::vector<Pose> X_BT, X_AS;
};
PosePairs posePairs(const Scene& scene, const ChannelMap& channels, const CalibrationRecording& data,
                    const ModelOptions& options);

}  // namespace live_stiffness
