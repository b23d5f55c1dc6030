#pragma once
// What a rig recorded in a bag: pressures, tracker poses and tip wrenches.

#include <functional>
#include <string>

#include "bags/bag_format.h"

namespace live_stiffness {

// Is told each message of a rig's three topics. recorded: when it was written to the bag, which is its time where it has no
// stamp of its own.
class BagListener {
 public:
  virtual ~BagListener() = default;
  virtual void onPressures(const Reading<Pressures>& reading, const ros::Time& recorded) = 0;
  virtual void onPose(const Reading<TrackedPose>& reading, const ros::Time& recorded) = 0;
  // As it stands in the message: what its axes are is for the listener to know.
  virtual void onWrench(const Reading<geometry_msgs::WrenchStamped>& reading, const ros::Time& recorded) = 0;
};

// When the messages of these topics were written to the bag; both zero when there are none.
struct BagSpan {
  ros::Time begin, end;
};

// Reads a bag in the order of recording. `progress` is told messages done and in all. Throws std::runtime_error with path,
// reason and what may mend it, in one line, when rosbag cannot read the file or one of its messages.
BagSpan readBag(const std::string& path, const BagFormat& format, BagListener& listener,
                const std::function<void(long, long)>& progress = {});

}  // namespace live_stiffness
