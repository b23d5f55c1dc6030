#include "live_stiffness/section/channel_map.h"

#include <algorithm>
#include <stdexcept>

#include "live_stiffness/checks.h"

namespace live_stiffness {

ChannelMap::ChannelMap(std::vector<int> channel_of_chamber) : channel_of_chamber_(std::move(channel_of_chamber)) {
  FaultList faults("channel map");
  if (channel_of_chamber_.empty()) faults.add("channel_of_chamber: must hold one channel index per chamber");
  for (size_t k = 0; k < channel_of_chamber_.size(); ++k) {
    const int channel = channel_of_chamber_[k];
    if (channel < 0 || channel >= kMaxChannels) {
      faults.add("channel_of_chamber[" + std::to_string(k) + "] = " + std::to_string(channel) + ": must be 0 to " +
                 std::to_string(kMaxChannels - 1));
    } else {
      channel_count_ = std::max(channel_count_, channel + 1);
    }
  }
  faults.throwIfAny();
}

ChannelMap ChannelMap::even(int channels, int chambers) {
  FaultList faults("channel map");
  if (channels < 1) faults.add("channels = " + std::to_string(channels) + ": must be at least 1");
  if (chambers < 1) faults.add("chambers = " + std::to_string(chambers) + ": must be at least 1");
  if (faults.empty() && chambers % channels != 0)
    faults.add("chambers = " + std::to_string(chambers) + ": must be a multiple of channels, " +
               std::to_string(channels));
  faults.throwIfAny();
  std::vector<int> channel_of_chamber(chambers);
  for (int k = 0; k < chambers; ++k) channel_of_chamber[k] = k / (chambers / channels);
  return ChannelMap(std::move(channel_of_chamber));
}

Pressures ChannelMap::expand(PressuresRef channels) const {
  Pressures chambers(chamberCount());
  if (!expandInto(channels, chambers))
    throw std::invalid_argument(std::to_string(channels.size()) + " channel pressures given: must be at least " +
                                std::to_string(channelCount()));
  return chambers;
}

bool ChannelMap::expandInto(PressuresRef channels, Eigen::Ref<Pressures> chambers) const {
  if (channels.size() < channelCount() || chambers.size() != chamberCount()) return false;
  for (int k = 0; k < chamberCount(); ++k) chambers[k] = channels[channel_of_chamber_[k]];
  return true;
}

}  // namespace live_stiffness
