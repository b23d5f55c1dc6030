#include "estimation/input_parameters.h"

namespace live_stiffness {

double PressureFormat::gauge(double value) const {
  return value * pascalsPerUnit(unit) - (isAbsolute() ? atmosphere : 0.0);
}

void checkFrames(const FrameNames& frames, const FrameParameter& body, FaultList& faults) {
  if (frames.base.empty() || frames.body.empty() || frames.base == frames.body)
    faults.add(kBaseFrame.key + (" = " + frames.base) + ", " + body.key + " = " + frames.body +
               ": must be two different names");
}

void InputParameters::check(int chambers, FaultList& faults) const {
  checkFrames(frames, kTipFrame, faults);
  if (!tracker_tf_frame.empty() && tracker_tf_frame == tracker_frame)
    faults.add(kTrackerTfFrame.key + (" = " + tracker_tf_frame) + ": must be the sensor's frame, another one than " +
               kTrackerFrame.key);
  const size_t mapped = channel_of_chamber.size();
  if (chambers > 0 && mapped != 0 && mapped != static_cast<size_t>(chambers))
    faults.add(kChannelOfChamber.key + (" has " + std::to_string(mapped)) + " entries: must have one for each of the " +
               "scene's " + std::to_string(chambers) + " chambers, or be empty");
}

}  // namespace live_stiffness
