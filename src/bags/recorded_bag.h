#pragma once
// Reads bags as recordings.

#include <string>
#include <vector>

#include "bags/bag_reader.h"
#include "live_stiffness/estimation/recording.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

// One sample per pose that the node would use, with the newest pressures and wrench of the force sensor before it, by the
// stamps that the node would use. Poses without pressures in the last pressure_timeout_s, and messages that cannot be used, are
// left out, and warnings say so. Several bags are one recording. scene: for what is plausible; nullptr: not known. Throws as
// playBags() does when a file cannot be read, and ConfigurationError when no sample is left.
Recording loadRecordedBags(const std::vector<std::string>& paths, const BagTopics& topics, const InputParameters& parameters,
                           const Scene* scene = nullptr);

// True if the file begins as bags do.
bool isBag(const std::string& path);

}  // namespace live_stiffness
