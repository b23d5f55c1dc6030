#pragma once
// Reads bags as recordings: those that recording_to_bag writes, or of similar drivers.

#include <string>

#include "live_stiffness/estimation/recording.h"
#include "bags/bag_reader.h"

namespace live_stiffness {

// One sample per valid pose, with the newest pressures and wrench of the force sensor before it, by their stamps (time of
// recording where they have none). Poses before the first pressures, and messages that cannot be used, are left out with a
// warning; implausible numbers, which point to wrong units, give a warning, too. Throws as readBag() does when the file
// cannot be read, and ConfigurationError when no sample is left.
Recording loadRecordedBag(const std::string& path, const BagFormat& format = {});

}  // namespace live_stiffness
