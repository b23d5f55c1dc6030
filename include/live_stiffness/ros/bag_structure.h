#pragma once
// Whether the lengths and places that a bag tells of itself lie within it. rosbag believes them, and reads where nothing
// is.

#include <string>

namespace live_stiffness {

// Of a bag of format 2.0, http://wiki.ros.org/Bags/Format/2.0; anything else is left to rosbag. ConfigurationError with
// the byte at which it is cut off or damaged. The size of a single message is left to readMessage().
void checkBagStructure(const std::string& path);

}  // namespace live_stiffness
