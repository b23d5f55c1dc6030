#pragma once
// Reads pressures, tracker poses and tip wrenches from a bag.

#include <functional>
#include <string>

#include "ros/conversions.h"

namespace live_stiffness {

// Topics with or without a leading slash. By default what recording_to_bag and simulate_bag write: gauge channel pressures,
// poses of the sensor in the tracker's frame, wrenches in the force sensor's own axes. These are not on tip_wrench, which the
// node would take as the wrench at T: the sensor's axes and sign must be known for that.
struct BagFormat {
  std::string pressure_topic = "chamber_pressures", pose_topic = "aurora_pose";
  std::string wrench_topic = "tip_force_torque";  // of the force sensor; replay reads a known wrench from tip_wrench instead
  PressureFormat pressures;
  std::string position_unit = kPositionUnit.standard;  // of the tracker's positions
};

// Gets each message of a rig's three topics. recorded: when it was written to the bag, which counts as its time if it has no
// stamp.
class BagListener {
 public:
  virtual ~BagListener() = default;
  virtual void onPressures(const Parsed<Pressures>& reading, const ros::Time& recorded) = 0;
  virtual void onPose(const Parsed<TrackedPose>& reading, const ros::Time& recorded) = 0;
  // The numbers of the message, in its axes; the listener must know these.
  virtual void onWrench(const Parsed<geometry_msgs::WrenchStamped>& reading, const ros::Time& recorded) = 0;
};

// When the messages of these topics were written to the bag; both zero when there are none.
struct BagSpan {
  ros::Time begin, end;
};

// Reads a bag in the order of recording. `progress` gets the number of messages done and their total. Throws std::runtime_error
// with path, reason and a possible remedy, in one line, when rosbag cannot read the file or one of its messages.
BagSpan readBag(const std::string& path, const BagFormat& format, BagListener& listener,
                const std::function<void(long, long)>& progress = {});

}  // namespace live_stiffness
