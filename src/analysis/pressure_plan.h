#pragma once
// The pressures of a stiffness map: a grid, or a random sample, over channels. Each row can be computed without the rows
// before it, so that threads can divide them freely.

#include <cstdint>
#include <vector>

#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

// Gauge pressures of one channel, Pa: `count` values at equal distances from `from` to `to`, both included; one value: `from`.
struct PressureRange {
  double from = 0.0;
  double to = 0.0;
  long count = 1;  // not used by a random sample
};

class PressurePlan {
 public:
  static constexpr long kMostRows = 1000000000;

  // All combinations, the last channel fastest. ranges: one per channel, or one for all of them. Throws
  // ConfigurationError on a wrong number of ranges, pressures below -1 atm or not finite, counts below 1, and more than
  // kMostRows rows.
  static PressurePlan grid(const std::vector<PressureRange>& ranges, ChannelMap channels);

  // `rows` draws, evenly distributed between the ends of each range. Row i depends on seed and i alone, on every
  // machine. Throws likewise.
  static PressurePlan sample(const std::vector<PressureRange>& ranges, ChannelMap channels, long rows,
                             std::uint64_t seed);

  long rows() const { return rows_; }
  const ChannelMap& channels() const { return channels_; }

  // Pressures of the chambers (base to tip) in a row, 0 to rows() - 1, Pa.
  void chamberPressures(long row, Eigen::Ref<Pressures> chambers) const;

 private:
  PressurePlan(std::vector<PressureRange> ranges, ChannelMap channels);
  double channelPressure(long row, int channel) const;

  std::vector<PressureRange> ranges_;
  std::vector<long> stride_;  // of a grid: rows from one pressure of the channel to its next; empty: a sample
  ChannelMap channels_;
  long rows_ = 1;
  std::uint64_t seed_ = 0;
};

}  // namespace live_stiffness
