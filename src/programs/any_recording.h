#pragma once
// Recordings of either kind, as programs take them.

#include <string>

#include "live_stiffness/estimation/recording.h"

namespace live_stiffness {

// A CSV recording, or a bag (*.bag) where the program was built with ROS. Prints the recording's warnings on standard
// error. Throws ConfigurationError when it cannot be read.
Recording loadAnyRecording(const std::string& path);

}  // namespace live_stiffness
