#pragma once
// A tracker sensor at the robot's base, so that the base may move.

#include "live_stiffness/estimation/recording.h"

namespace live_stiffness {

// True if each sample has position and orientation of a base sensor.
bool hasBasePoses(const Recording& recording);

// The recording with the tip's poses in the axes of the base sensor, which then takes the place of the tracker's frame A, and
// without the base's own. As it is unless hasBasePoses(). Weight must not turn with the base: the scene has one gravity.
Recording relativeToBase(const Recording& recording);

}  // namespace live_stiffness
