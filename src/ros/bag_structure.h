#pragma once
// Whether the lengths and places that a bag tells of itself lie within it. rosbag believes them, and reads where nothing
// is.

#include <cstdint>
#include <string>

namespace live_stiffness {

// Bytes; pressures of a thousand chambers. What is larger is none of our messages, or damaged.
constexpr uint32_t kLargestMessage = 16384;

// Of a bag of format 2.0, http://wiki.ros.org/Bags/Format/2.0. ConfigurationError if it is of another format, or with the
// byte at which it is cut off or damaged; a file that cannot be read is left to rosbag. A message that says to be larger
// than kLargestMessage is left to readMessage(), so that one does not spoil the rest. Compressed chunks are unpacked for it;
// into encrypted ones it does not look.
void checkBagStructure(const std::string& path);

}  // namespace live_stiffness
