#pragma once
// The result of reading a message.

#include <ros/time.h>

#include <cstdint>
#include <optional>
#include <string>

namespace live_stiffness {

// A message as one of the core's types, or the reason why it cannot be used.
template <class Value>
struct Parsed {
  ros::Time stamp;  // zero: the message has none
  Value value;
  std::string error;                      // empty: `value` is valid
  std::optional<uint32_t> sequence = {};  // the publisher's number of the message, if it numbers them

  bool ok() const { return error.empty(); }
};

// From `earlier` to `later`, s. The difference of two ros::Time throws beyond 68 years, and a stamp may be garbage.
inline double secondsBetween(const ros::Time& earlier, const ros::Time& later) {
  return 1e-9 * static_cast<double>(static_cast<int64_t>(later.toNSec() - earlier.toNSec()));
}

}  // namespace live_stiffness
