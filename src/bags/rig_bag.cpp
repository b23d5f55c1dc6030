#include "bags/rig_bag.h"

namespace live_stiffness {

RigBag::RigBag(const std::string& path, std::string tracker_frame)
    : bag_(path), tracker_frame_(std::move(tracker_frame)) {}

void RigBag::write(PressuresRef channel_pressures, const ros::Time& stamp) {
  bag_.write("chamber_pressures", stamp, toPressures(channel_pressures, stamp));
}

void RigBag::write(const Pose& X_AS, const ros::Time& stamp) {
  bag_.write("aurora_pose", stamp, toPoseStamped(X_AS, stamp, tracker_frame_));
}

void RigBag::writeForceTorque(const Wrench& wrench, const ros::Time& stamp) {
  bag_.write("tip_force_torque", stamp, toWrenchStamped(wrench, stamp, kForceSensorFrame));
}

}  // namespace live_stiffness
