// CSV recordings: refused with a ConfigurationError, or samples in order of time, all finite, all of one channel count.

#include <cmath>

#include "fuzz_target.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/estimation/recording.h"

using namespace live_stiffness;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  Recording recording;
  try {
    recording = parseRecording(textOf(data, size), "fuzz");
  } catch (const ConfigurationError& error) {
    require(!error.faults().empty(), "a refusal has a reason");
    return 0;
  }
  require(!recording.samples.empty(), "a recording has a sample");
  const RecordedSample* last = nullptr;
  for (const RecordedSample& sample : recording.samples) {
    require(last == nullptr || sample.time > last->time, "time increases");
    require(sample.pressures.size() == recording.channelCount(), "the number of channels stays");
    require(sample.pressures.allFinite() && sample.tip_position.allFinite(), "values are finite");
    require(std::abs(sample.tip_orientation.norm() - 1.0) < 1e-12, "orientations are of unit norm");
    require(!sample.tip_wrench || sample.tip_wrench->allFinite(), "wrenches are finite");
    last = &sample;
  }
  require(gaugePressures(recording).size() == recording.samples.size(), "a gauge pressure a sample");
  require(quasiStaticSamples(recording).size() <= recording.samples.size(), "samples at rest are samples");
  return 0;
}
