#pragma once
// Which pressure channel feeds which chamber. One regulator often feeds several chambers: the recorded robot has three
// channels, each for a pair of its six chambers.

#include <vector>

#include "live_stiffness/parameters.h"

namespace live_stiffness {

class ChannelMap {
 public:
  // channel_of_chamber: for each chamber, base to tip in the order of the scene, the index of its channel, from 0.
  // Channels that no chamber has are spare: a valve terminal has more outlets than most robots have chambers. Throws
  // ConfigurationError on an empty list, and on an index outside 0 to kMaxChannels - 1.
  explicit ChannelMap(std::vector<int> channel_of_chamber);

  // Neighbouring chambers in groups of equal size, one for each channel: even(3, 6) is {0, 0, 1, 1, 2, 2}, even(n, n) the
  // identity. Throws ConfigurationError unless both are positive and chambers is a multiple of channels.
  static ChannelMap even(int channels, int chambers);

  int channelCount() const { return channel_count_; }  // that are needed at least
  int chamberCount() const { return static_cast<int>(channel_of_chamber_.size()); }
  const std::vector<int>& channelOfChamber() const { return channel_of_chamber_; }

  // Chamber pressures from channel pressures, both in the same unit; values are copied as they are, NaN included.
  // Throws std::invalid_argument if there are fewer than channelCount() values.
  Pressures expand(PressuresRef channels) const;

  // The same into a vector of chamberCount() values, without allocation: for live use. False, and `chambers` left as it is,
  // when there are too few channels, or not chamberCount() chambers.
  bool expandInto(PressuresRef channels, Eigen::Ref<Pressures> chambers) const;

 private:
  std::vector<int> channel_of_chamber_;
  int channel_count_ = 0;
};

}  // namespace live_stiffness
