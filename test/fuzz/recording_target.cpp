// CSV recordings: refused with a ConfigurationError, or samples in order of time, all finite, all of one channel count.

#include "live_stiffness/checks.h"
#include "recording_checks.h"

using namespace live_stiffness;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  try {
    requireSound(parseRecording(textOf(data, size), "fuzz"));
  } catch (const ConfigurationError& error) {
    require(!error.faults().empty(), "a refusal has a reason");
  }
  return 0;
}
