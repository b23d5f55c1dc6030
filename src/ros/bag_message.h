#pragma once
// A message out of a bag, which may be damaged.

#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <string>

#include "ros/bag_structure.h"

namespace live_stiffness {

// Null, and `fault` says why, if it cannot be read or is of another type. The size is looked at first: rosbag takes it as
// it stands in the bag, and reads on behind the end of what it has.
template <class Message>
boost::shared_ptr<Message> readMessage(const rosbag::MessageInstance& instance, std::string& fault) {
  try {
    if (instance.size() < 1 || instance.size() > kLargestMessage) {
      fault = std::to_string(instance.size()) + " bytes: must be from 1 to " + std::to_string(kLargestMessage) +
              "; the bag may be damaged";
      return nullptr;
    }
    if (boost::shared_ptr<Message> message = instance.instantiate<Message>()) return message;
    fault = std::string("is no ") + ros::message_traits::datatype<Message>();
  } catch (const std::exception& error) {
    fault = std::string("cannot be read: ") + error.what();
  }
  return nullptr;
}

}  // namespace live_stiffness
