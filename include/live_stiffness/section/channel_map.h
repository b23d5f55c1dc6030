#pragma once
// Which pressure channel feeds which chamber. One regulator often feeds several chambers: the recorded robot has three
// channels, each for a pair of its six chambers.

#include <vector>

#include "live_stiffness/parameters.h"

namespace live_stiffness {

class ChannelMap {
 public:
  // channel_of_chamber: for each chamber, base to tip in the order of the scene, the index of its channel, from 0.
  // Throws ConfigurationError on an empty list, an index outside 0 to kMaxChannels - 1, and an index below the highest
  // one that no chamber has: that is much more often a typing error than an unused regulator.
  explicit ChannelMap(std::vector<int> channel_of_chamber);

  // Neighbouring chambers in groups of equal size, one for each channel: even(3, 6) is {0, 0, 1, 1, 2, 2}, even(n, n) the
  // identity. Throws ConfigurationError unless both are positive and chambers is a multiple of channels.
  static ChannelMap even(int channels, int chambers);

  int channelCount() const { return channel_count_; }
  int chamberCount() const { return static_cast<int>(channel_of_chamber_.size()); }
  const std::vector<int>& channelOfChamber() const { return channel_of_chamber_; }

  // Chamber pressures from channel pressures, both in the same unit; values are copied as they are, NaN included.
  // Throws std::invalid_argument unless there are channelCount() values.
  Pressures expand(PressuresRef channels) const;

  // The same into a vector of chamberCount() values, without allocation: for live use. False, and `chambers` left as
  // it is, when either has the wrong size.
  bool expandInto(PressuresRef channels, Eigen::Ref<Pressures> chambers) const;

 private:
  std::vector<int> channel_of_chamber_;
  int channel_count_ = 0;
};

}  // namespace live_stiffness
