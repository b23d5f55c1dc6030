#pragma once
// Writes a bag completely or not at all, even if the disk becomes full.

#include <rosbag/bag.h>

#include <memory>
#include <string>

#include "part_file.h"

namespace live_stiffness {

class OutputBag {
 public:
  // Creates the file under a temporary name (see PartFile). All members throw ConfigurationError with path and reason on
  // failure.
  explicit OutputBag(const std::string& path);
  // Without finish() the file is removed.
  ~OutputBag();

  // topic: with or without a leading slash; it is written with one, as rosbag record does.
  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message) {
    guard([&] { bag_->write(topic.front() == '/' ? topic : "/" + topic, time, message); });
  }
  // Call when all has been written: closes the bag and gives it its name.
  void finish();

 private:
  template <class Action>
  void guard(Action action) {
    try {
      action();
    } catch (const rosbag::BagException& error) {
      fail(error.what());
    }
  }
  [[noreturn]] void fail(const std::string& reason);
  void abandon();

  std::string path_;
  PartFile part_;
  std::unique_ptr<rosbag::Bag> bag_;
};

// Stamp of a time since the begin of a recording, s; ROS time must not be zero.
inline ros::Time bagTime(double seconds) { return ros::Time(1000.0 + seconds); }

// Between messages of one sample: rosbag gives those of one time in no certain order (findings/bag_order_at_one_time.sh).
inline const ros::Duration kNextMessage(1e-4);

}  // namespace live_stiffness
