#include "live_stiffness/ros/rig_bag.h"

#include "live_stiffness/checks.h"

namespace live_stiffness {

RigBag::RigBag(const std::string& path, std::string tracker_frame) : tracker_frame_(std::move(tracker_frame)) {
  try {
    bag_.open(path, rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    throw ConfigurationError("bag " + path, {std::string("cannot be written: ") + error.what()});
  }
}

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
