#pragma once
// What a tracker measures of its sensor: not every one gives a whole pose.

#include <string>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

enum class TrackerMeasures {
  kPose,
  kPosition,         // one marker: whatever stands for its orientation means nothing
  kPositionAndAxis,  // a coil with five degrees of freedom: its z axis, while the turn about that is noise
};

// "pose", "position" or "position_and_axis", the choices of kTrackerMeasures; any other name counts as pose.
TrackerMeasures trackerMeasuresNamed(const std::string& name);
std::string trackerMeasuresName(TrackerMeasures measures);

// X_AS with what was not measured taken from the pose that the model expects: its rotation, or its turn about the measured
// z axis, so that the rotation between both is the smallest one. Frames as those of X_AS.
Pose completedPose(const Pose& X_AS, const Pose& expected, TrackerMeasures measures);

}  // namespace live_stiffness
