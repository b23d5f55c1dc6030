#pragma once
// Linear interpolation in a series of times.

#include <algorithm>
#include <vector>

namespace live_stiffness {

// Value at `time` of a series of values at ascending times, as many; outside, that of the nearest end. Not of an empty series.
template <class Value>
Value interpolated(const std::vector<double>& times, const std::vector<Value>& values, double time) {
  if (!(time > times.front())) return values.front();
  const auto after = static_cast<size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (after == times.size()) return values.back();
  const double share = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return (1.0 - share) * values[after - 1] + share * values[after];
}

}  // namespace live_stiffness
