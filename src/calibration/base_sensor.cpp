#include "calibration/base_sensor.h"

#include <algorithm>

namespace live_stiffness {

bool hasBasePoses(const Recording& recording) {
  return std::all_of(recording.samples.begin(), recording.samples.end(), [](const RecordedSample& sample) {
    return sample.base_position && sample.base_orientation;
  });
}

Recording relativeToBase(const Recording& recording) {
  Recording result = recording;
  if (!hasBasePoses(recording)) return result;
  const RecordedSample* previous = nullptr;
  for (RecordedSample& sample : result.samples) {
    const Eigen::Quaterniond to_base = sample.base_orientation->normalized().conjugate();
    sample.tip_position = to_base * (sample.tip_position - *sample.base_position);
    sample.tip_orientation = (to_base * sample.tip_orientation).normalized();
    if (previous != nullptr && previous->tip_orientation.dot(sample.tip_orientation) < 0.0)
      sample.tip_orientation.coeffs() *= -1.0;
    sample.base_position.reset();
    sample.base_orientation.reset();
    previous = &sample;
  }
  return result;
}

}  // namespace live_stiffness
