#pragma once
// Linear interpolation in a series of times.

#include <algorithm>
#include <vector>

namespace live_stiffness {

// Position of `time` in ascending times: between samples `before` and `before + 1`, `share` of the way; at the nearest
// end when outside. times must not be empty; a series of one sample has share 0.
struct TimePlace {
  size_t before = 0;
  double share = 0.0;
};
inline TimePlace placeIn(const std::vector<double>& times, double time) {
  if (times.size() < 2 || !(time > times.front())) return {};
  const size_t after = static_cast<size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (after >= times.size()) return {times.size() - 2, 1.0};
  return {after - 1, (time - times[after - 1]) / (times[after] - times[after - 1])};
}

// Value at that position. values: as many as times.
template <class Value>
Value valueAt(const std::vector<Value>& values, const TimePlace& place) {
  if (place.share == 0.0) return values[place.before];
  return (1.0 - place.share) * values[place.before] + place.share * values[place.before + 1];
}

}  // namespace live_stiffness
