#pragma once
// Reads pressures, tracker poses and tip wrenches from a bag.

#include <functional>
#include <string>

#include "bags/bag_format.h"

namespace live_stiffness {

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
