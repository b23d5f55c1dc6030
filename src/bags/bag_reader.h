#pragma once
// Plays bags to the parts that take a rig's messages live. ros::Time::now() is then the time at which the present message was
// recorded, which counts as the time of its arrival.

#include <geometry_msgs/WrenchStamped.h>
#include <ros/time.h>
#include <sensor_msgs/FluidPressure.h>
#include <tf2_msgs/TFMessage.h>
#include <topic_tools/shape_shifter.h>

#include <functional>
#include <string>
#include <vector>

#include "estimation/input_parameters.h"

namespace live_stiffness {

// Topics, with or without a leading slash. By default what recording_to_bag and simulate_bag write. The force sensor's are
// not on tip_wrench, which the node would take as the wrench at T: the sensor's axes and sign must be known for that.
struct BagTopics {
  std::string pressures = "chamber_pressures", pose = "aurora_pose";
  std::string wrench = "tip_force_torque";  // of the force sensor; replay reads a known wrench from tip_wrench instead
};

class BagListener {
 public:
  virtual ~BagListener() = default;
  virtual void onPressures(const topic_tools::ShapeShifter& message) = 0;
  virtual void onChannelPressure(const sensor_msgs::FluidPressure& message, size_t channel) = 0;
  virtual void onPose(const topic_tools::ShapeShifter& message) = 0;
  virtual void onTf(const tf2_msgs::TFMessage& transforms, bool is_static) = 0;
  virtual void onWrench(const geometry_msgs::WrenchStamped& message) = 0;
  virtual void onHeartbeat() = 0;
  // A message on one of the topics is of a type that nothing reads.
  virtual void onForeign(const std::string& topic, const std::string& type) = 0;
};

// When the messages of these topics were recorded; both zero when there are none.
struct BagSpan {
  ros::Time begin, end;
  double duration() const { return (end - begin).toSec(); }
};

// Plays the bags together, in the order of recording: the parts of one that was split, for example. parameters: with
// pressure_topics or aurora_tf_frame these, or tf, are read instead of one topic. heartbeat: s between calls of onHeartbeat().
// progress: gets the number of messages done and their total. Throws std::runtime_error with path, reason and a possible
// remedy, in one line, when rosbag cannot read a file or one of its messages.
BagSpan playBags(const std::vector<std::string>& paths, const BagTopics& topics, const InputParameters& parameters,
                 double heartbeat, BagListener& listener, const std::function<void(long, long)>& progress = {});

}  // namespace live_stiffness
