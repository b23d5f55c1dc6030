#include "calibration/pose_pairs.h"

#include "estimation/creep.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

PosePairs posePairs(const Scene& scene, const ChannelMap& channels, const CalibrationRecording& data,
                    const ModelOptions& options) {
  const StiffnessModel model(scene, options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  SceneCreep creep(scene);
  PosePairs pairs;
  constexpr int kMostFailures = 50;  // each takes long, and then the moduli are wrong, which calibrate() finds
  int failures = 0;
  for (size_t i = 0; i < data.used.size(); ++i) {
    const RecordedSample& sample = data.recording.samples[i];
    const Pressures& effective = creep.update(data.channels[i], sample.time);
    if (!data.used[i] || sample.unchanged_for > 0.0) continue;
    const StiffnessSolution solution = model.solve(channels.expand(effective), Wrench::Zero(), workspace);
    if (!solution.status.ok()) {
      if (++failures > kMostFailures) break;
      workspace.reset();
      continue;
    }
    pairs.X_BT.push_back(solution.X_BT);
    pairs.X_AS.push_back(sample.tipPose());
  }
  return pairs;
}

}  // namespace live_stiffness
