#pragma once
// Chamber pressures from the topics of a rig.

#include <sensor_msgs/FluidPressure.h>

#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/section/channel_map.h"
#include "ros/any_type_subscriber.h"
#include "ros/input_status.h"
#include "ros/node_parameters.h"

namespace live_stiffness {

// Of channel_of_chamber; without it one channel per chamber of the scene. Throws ConfigurationError.
ChannelMap makeChannelMap(const NodeParameters& parameters);

class PressureInput {
 public:
  // parameters must outlive the input.
  explicit PressureInput(const NodeParameters& parameters);

  // Gauge pressures (Pa, one per chamber) and the stamp to use for them. None if the message cannot be used.
  std::optional<Parsed<Pressures>> read(const AnyMessage& message);
  // The same if each channel has its own topic, one of ~pressure_topics; also none unless every channel has sent a good
  // message within ~pressure_timeout_s. channel: from 0.
  std::optional<Parsed<Pressures>> readChannel(const sensor_msgs::FluidPressure& message, size_t channel);
  // Another scene or channel_of_chamber.
  void setChannels(ChannelMap channels);

  int channelCount() const { return channel_map_.channelCount(); }
  ArrayStatus& status() { return status_; }
  const ArrayStatus& status() const { return status_; }

 private:
  std::optional<Parsed<Pressures>> chamberPressures(Parsed<Pressures> channels, const std::string& publisher);
  bool isComplete(const ros::Time& now) const;

  const NodeParameters& parameters_;
  ChannelMap channel_map_;
  ArrayStatus status_;
  Pressures channels_;             // newest of each of ~pressure_topics
  std::vector<ros::Time> arrivals_;  // of the newest good message of each; zero: none since the last bad one
  std::vector<ros::Time> stamps_;    // of the newest message of each
};

}  // namespace live_stiffness
