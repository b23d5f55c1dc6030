#pragma once
// What holds of every recording that was not refused, whichever file it comes from.

#include <cmath>

#include "fuzz_target.h"
#include "live_stiffness/estimation/recording.h"

namespace live_stiffness {

inline void requireSound(const Recording& recording) {
  require(!recording.samples.empty(), "a recording has a sample");
  const RecordedSample* last = nullptr;
  for (const RecordedSample& sample : recording.samples) {
    require(last == nullptr || sample.time > last->time, "time increases");
    require(sample.pressures.size() == recording.channelCount(), "the number of channels stays");
    require(sample.pressures.allFinite() && sample.tip_position.allFinite(), "values are finite");
    require(std::abs(sample.tip_orientation.norm() - 1.0) < 1e-12, "orientations are of unit norm");
    require(!sample.base_orientation || std::abs(sample.base_orientation->norm() - 1.0) < 1e-12, "of the base, too");
    require(sample.unchanged_for >= 0.0 && std::isfinite(sample.unchanged_for),
            "a pose is repeated for a time");
    require(!sample.tip_wrench || sample.tip_wrench->allFinite(), "wrenches are finite");
    last = &sample;
  }
  require(gaugePressures(recording).size() == recording.samples.size(), "a gauge pressure a sample");
  require(quasiStaticSamples(recording).size() <= recording.samples.size(), "samples at rest are samples");
}

}  // namespace live_stiffness
