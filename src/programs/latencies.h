#pragma once
// Percentiles of latencies.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace live_stiffness {

class Latencies {
 public:
  // In seconds, in any order.
  explicit Latencies(std::vector<double> seconds) : sorted_(std::move(seconds)) { std::sort(sorted_.begin(), sorted_.end()); }
  // That a share (0 to 1) of them does not exceed, in microseconds; NaN without any.
  double at(double share) const {
    return sorted_.empty() ? NAN : 1e6 * sorted_[std::min<size_t>(sorted_.size() - 1, share * sorted_.size())];
  }

 private:
  std::vector<double> sorted_;  // s
};

}  // namespace live_stiffness
