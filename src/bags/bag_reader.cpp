#include "bags/bag_reader.h"

#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <stdexcept>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

Parsed<geometry_msgs::WrenchStamped> wrenchOf(const rosbag::MessageInstance& message) {
  Parsed<geometry_msgs::WrenchStamped> reading;
  if (const auto wrench = message.instantiate<geometry_msgs::WrenchStamped>()) {
    reading.stamp = wrench->header.stamp;
    reading.value = *wrench;
  } else {
    reading.error = "message type " + message.getDataType() + ": must be geometry_msgs/WrenchStamped";
  }
  return reading;
}

}  // namespace

BagSpan readBag(const std::string& path, const BagFormat& format, BagListener& listener,
                const std::function<void(long, long)>& progress) {
  const std::string pressures = withoutSlash(format.pressure_topic), poses = withoutSlash(format.pose_topic),
                    wrenches = withoutSlash(format.wrench_topic);
  try {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    rosbag::View view(bag, [&](const rosbag::ConnectionInfo* connection) {
      const std::string topic = withoutSlash(connection->topic);
      return topic == pressures || topic == poses || topic == wrenches;
    });
    const long total = view.size();
    long done = 0;
    for (const rosbag::MessageInstance& message : view) {
      const std::string topic = withoutSlash(message.getTopic());
      if (topic == wrenches) {
        listener.onWrench(wrenchOf(message), message.getTime());
      } else {
        const auto any = message.instantiate<topic_tools::ShapeShifter>();  // any type
        if (topic == pressures) listener.onPressures(readPressures(*any, format.pressures), message.getTime());
        else listener.onPose(readPose(*any, metresPerUnit(format.position_unit)), message.getTime());
      }
      if (progress) progress(++done, total);
    }
    return total > 0 ? BagSpan{view.getBeginTime(), view.getEndTime()} : BagSpan{};
  } catch (const ConfigurationError&) {
    throw;  // from the listener
  } catch (const std::exception& error) {
    throw std::runtime_error("bag " + path + ": cannot be read: " + error.what() + "; if it was cut off, `rosbag reindex " +
                             path + "` recovers the complete part");
  }
}

}  // namespace live_stiffness
