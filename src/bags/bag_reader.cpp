#include "bags/bag_reader.h"

#include <ros/console.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <list>
#include <map>
#include <stdexcept>

#include "live_stiffness/checks.h"
#include "parameter_reader.h"

namespace live_stiffness {
namespace {

using Play = std::function<void(const rosbag::MessageInstance&)>;

// Calls `use` with a message of its type.
template <class Message, class Use>
Play typed(BagListener& listener, Use use) {
  return [&listener, use](const rosbag::MessageInstance& instance) {
    if (const auto message = instance.instantiate<Message>()) use(*message);
    else listener.onForeign(instance.getTopic(), instance.getDataType());
  };
}

Play anyType(void (BagListener::*use)(const topic_tools::ShapeShifter&), BagListener& listener) {
  return [&listener, use](const rosbag::MessageInstance& instance) {
    (listener.*use)(*instance.instantiate<topic_tools::ShapeShifter>());
  };
}

// What to do with the messages of each topic.
std::map<std::string, Play> playsOf(const BagTopics& topics, const InputParameters& parameters, BagListener& listener) {
  std::map<std::string, Play> plays;
  for (size_t channel = 0; channel < parameters.pressure_topics.size(); ++channel)
    plays[withoutSlash(parameters.pressure_topics[channel])] = typed<sensor_msgs::FluidPressure>(
        listener, [&listener, channel](const auto& message) { listener.onChannelPressure(message, channel); });
  if (parameters.pressure_topics.empty()) plays[withoutSlash(topics.pressures)] = anyType(&BagListener::onPressures, listener);
  if (parameters.tracker_tf_frame.empty()) plays[withoutSlash(topics.pose)] = anyType(&BagListener::onPose, listener);
  else
    for (const bool is_static : {true, false})
      plays[is_static ? "tf_static" : "tf"] = typed<tf2_msgs::TFMessage>(
          listener, [&listener, is_static](const auto& message) { listener.onTf(message, is_static); });
  plays[withoutSlash(topics.wrench)] =
      typed<geometry_msgs::WrenchStamped>(listener, [&listener](const auto& message) { listener.onWrench(message); });
  return plays;
}

}  // namespace

BagSpan playBags(const std::vector<std::string>& paths, const BagTopics& topics, const InputParameters& parameters,
                 double heartbeat, BagListener& listener, const std::function<void(long, long)>& progress) {
  const std::map<std::string, Play> plays = playsOf(topics, parameters, listener);
  std::string path = paths.empty() ? "" : paths.front();
  try {
    std::list<rosbag::Bag> bags;
    rosbag::View view;
    for (const std::string& each : paths) {
      path = each;
      view.addQuery(bags.emplace_back(path, rosbag::bagmode::Read),
                    [&](const rosbag::ConnectionInfo* connection) { return plays.count(withoutSlash(connection->topic)) > 0; });
    }
    path = oneLine(paths);
    // What is wrong is told in a report at the end, not once a message.
    ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);
    ros::console::notifyLoggerLevelsChanged();
    const long total = view.size();
    long done = 0;
    ros::Time::init();  // without a master
    ros::Time beat;
    for (const rosbag::MessageInstance& message : view) {
      const ros::Time now = message.getTime();
      if (done == 0 || now < beat - ros::Duration(heartbeat)) beat = now;
      for (; beat + ros::Duration(heartbeat) <= now; listener.onHeartbeat()) {
        beat += ros::Duration(heartbeat);
        ros::Time::setNow(beat);
      }
      ros::Time::setNow(now);
      plays.at(withoutSlash(message.getTopic()))(message);
      if (progress) progress(++done, total);
      else ++done;
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
