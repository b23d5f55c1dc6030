#include "analysis/pressure_plan.h"

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): the n-th number of a stream, computed from n alone.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + (n + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double unitInterval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

std::vector<PressureRange> checked(std::vector<PressureRange> ranges, int channels, bool with_count) {
  FaultList faults("pressures of the map");
  if (ranges.size() == 1) ranges.resize(channels, ranges[0]);
  if (static_cast<int>(ranges.size()) != channels)
    faults.add(std::to_string(ranges.size()) + " ranges given: must be 1, or one for each of the " +
               std::to_string(channels) + " channels");
  const Range legal{-kAtmospherePa, kInfinity, false, true};
  for (const PressureRange& range : ranges) {
    faults.check("from (Pa, gauge)", range.from, legal);
    faults.check("to (Pa, gauge)", range.to, legal);
    if (with_count) faults.check("count", static_cast<double>(range.count), {1.0, 1.0 * PressurePlan::kMostRows});
  }
  faults.throwIfAny();
  return ranges;
}

}  // namespace

PressurePlan::PressurePlan(std::vector<PressureRange> ranges, ChannelMap channels)
    : ranges_(std::move(ranges)), channels_(std::move(channels)) {}

PressurePlan PressurePlan::grid(const std::vector<PressureRange>& ranges, ChannelMap channels) {
  const int count = channels.channelCount();
  PressurePlan plan(checked(ranges, count, true), std::move(channels));
  plan.stride_.resize(count);
  for (int k = count - 1; k >= 0; --k) {
    plan.stride_[k] = plan.rows_;
    if (plan.rows_ > kMostRows / plan.ranges_[k].count)
      throw ConfigurationError("pressures of the map", {"the grid has more than " + numberText(1.0 * kMostRows) +
                                                        " rows: lower the counts, or draw a random sample"});
    plan.rows_ *= plan.ranges_[k].count;
  }
  return plan;
}

PressurePlan PressurePlan::sample(const std::vector<PressureRange>& ranges, ChannelMap channels, long rows,
                                  std::uint64_t seed) {
  FaultList faults("pressures of the map");
  faults.check("random", static_cast<double>(rows), {1.0, 1.0 * kMostRows});
  faults.throwIfAny();
  const int count = channels.channelCount();
  PressurePlan plan(checked(ranges, count, false), std::move(channels));
  plan.rows_ = rows;
  plan.seed_ = seed;
  return plan;
}

double PressurePlan::channelPressure(long row, int channel) const {
  const PressureRange& range = ranges_[channel];
  if (stride_.empty()) {
    const std::uint64_t place = static_cast<std::uint64_t>(row) * channels_.channelCount() + channel;
    return range.from + unitInterval(mixed(seed_, place)) * (range.to - range.from);
  }
  const long step = row / stride_[channel] % range.count;
  if (step == range.count - 1 && step > 0) return range.to;
  return step == 0 ? range.from : range.from + step * ((range.to - range.from) / (range.count - 1));
}

void PressurePlan::chamberPressures(long row, Eigen::Ref<Pressures> chambers) const {
  const std::vector<int>& channel = channels_.channelOfChamber();
  for (size_t k = 0; k < channel.size(); ++k) chambers[k] = channelPressure(row, channel[k]);
}

}  // namespace live_stiffness
