#pragma once
// Writes the topics of a rig to a bag: chamber_pressures, aurora_pose and, if there is one, its force sensor.

#include <string>

#include "ros/conversions.h"
#include "bags/output_bag.h"

namespace live_stiffness {

class RigBag {
 public:
  // Creates the file, see OutputBag, which says what is thrown. tracker_frame: frame_id of poses.
  RigBag(const std::string& path, std::string tracker_frame);

  // Gauge channel pressures, Pa, on chamber_pressures.
  void write(PressuresRef channel_pressures, const ros::Time& stamp);
  // Pose of the sensor in the tracker's frame, on aurora_pose.
  void write(const Pose& X_AS, const ros::Time& stamp);
  // A wrench in the force sensor's own axes, on tip_force_torque with frame_id kForceSensorFrame. Not on tip_wrench:
  // the node would take it as the wrench at T, and the sensor's axes and sign must be known for that.
  void writeForceTorque(const Wrench& wrench, const ros::Time& stamp);
  // Call when all has been written. Without it there is no file.
  void finish() { bag_.finish(); }

 private:
  OutputBag bag_;
  std::string tracker_frame_;
};

// First stamp of a bag; ROS time must not be zero.
inline ros::Time bagTime(double seconds) { return ros::Time(1000.0 + seconds); }

}  // namespace live_stiffness
