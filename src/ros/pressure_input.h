#pragma once
// Chamber pressures from a rig's messages. Knows no subscriber.

#include <sensor_msgs/FluidPressure.h>
#include <topic_tools/shape_shifter.h>

#include <optional>
#include <string>

#include "estimation/pressure_levels.h"
#include "live_stiffness/section/channel_map.h"
#include "ros/conversions.h"
#include "ros/input_status.h"

namespace live_stiffness {

class PressureInput {
 public:
  // parameters must outlive the input. scene: feeds its chambers; nullptr: not known, and channels are chambers.
  PressureInput(const InputParameters& parameters, const Scene* scene);

  // Gauge pressures (Pa, one per channel) and the stamp to use for them. None if the message cannot be used. publisher: its
  // name, so that lost messages can be counted; may be empty.
  std::optional<Parsed<Pressures>> read(const topic_tools::ShapeShifter& message, const std::string& publisher);
  // The same if each channel has its own topic, one of ~pressure_topics; also none unless every channel has sent a good
  // message within ~pressure_timeout_s. channel: from 0.
  std::optional<Parsed<Pressures>> readChannel(const sensor_msgs::FluidPressure& message, size_t channel);
  // Call it when scene or channel_of_chamber in the parameters have changed.
  void setScene(const Scene& scene);
  // Pressures of the chambers from those of the channels, as read.
  Pressures chambers(PressuresRef channels) const {
    return channel_map_ ? channel_map_->expand(channels) : Pressures(channels);
  }

  int channelCount() const { return status_.count(); }
  ArrayStatus& status() { return status_; }
  const ArrayStatus& status() const { return status_; }
  // The first thing that was doubtful about good pressures; empty: nothing was.
  const std::string& firstDoubt() const { return first_doubt_; }
  // The first topic of a channel that has sent nothing good for ~pressure_timeout_s, and since when; empty: all have.
  std::string silentChannel() const;
  // The same of the first time that one was silent, for a report at the end.
  std::string firstSilence() const { return first_silence_.empty() ? silentChannel() : first_silence_; }
  void diagnose(const std::string& solver_error, diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  std::optional<Parsed<Pressures>> accepted(Parsed<Pressures> channels, const std::string& publisher);

  const InputParameters& parameters_;
  std::optional<ChannelMap> channel_map_;  // none: a channel is a chamber
  ArrayStatus status_;
  PressureLevels levels_;
  std::string first_doubt_, first_silence_;
  Pressures channels_;               // newest of each of ~pressure_topics
  std::vector<ros::Time> arrivals_;  // of the newest good message of each; zero: none since the last bad one
  std::vector<ros::Time> stamps_;    // of the newest message of each
};

}  // namespace live_stiffness
