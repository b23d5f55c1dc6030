#include "bags/bag_reader.h"

#include <ros/console.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <list>
#include <map>
#include <stdexcept>
#include <utility>

#include "live_stiffness/checks.h"
#include "parameter_reader.h"

namespace live_stiffness {
namespace {

const ros::Duration kLongestPause(3600.0);  // in which the heart beats; bags of two days may be played together

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

// What to do with the messages of a topic. rosbag gives those of one time in no certain order
// (findings/bag_order_at_one_time.sh); here smaller ranks go first: channel by channel, the tracker, the wrench.
struct Topic {
  size_t rank = 0;
  Play play;
};

std::map<std::string, Topic> topicsOf(const BagTopics& topics, const InputParameters& parameters, BagListener& listener) {
  std::map<std::string, Topic> plays;
  const size_t channels = parameters.pressure_topics.size();
  for (size_t channel = 0; channel < channels; ++channel)
    plays[withoutSlash(parameters.pressure_topics[channel])] = {
        channel, typed<sensor_msgs::FluidPressure>(listener, [&listener, channel](const auto& message) {
          listener.onChannelPressure(message, channel);
        })};
  if (channels == 0) plays[withoutSlash(topics.pressures)] = {0, anyType(&BagListener::onPressures, listener)};
  if (parameters.tracker_tf_frame.empty())
    plays[withoutSlash(topics.pose)] = {channels + 1, anyType(&BagListener::onPose, listener)};
  else
    for (const bool is_static : {true, false})
      plays[is_static ? "tf_static" : "tf"] = {
          channels + (is_static ? 1 : 2), typed<tf2_msgs::TFMessage>(listener, [&listener, is_static](const auto& message) {
            listener.onTf(message, is_static);
          })};
  plays[withoutSlash(topics.wrench)] = {
      channels + 3,
      typed<geometry_msgs::WrenchStamped>(listener, [&listener](const auto& message) { listener.onWrench(message); })};
  return plays;
}

}  // namespace

BagSpan playBags(const std::vector<std::string>& paths, const BagTopics& topics, const InputParameters& parameters,
                 double heartbeat, BagListener& listener, const std::function<void(long, long)>& progress) {
  const std::map<std::string, Topic> plays = topicsOf(topics, parameters, listener);
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
    std::multimap<size_t, std::pair<const Play*, rosbag::MessageInstance>> together;  // of one time, by rank
    const auto play_together = [&] {
      for (const auto& [rank, message] : together) {
        (*message.first)(message.second);
        ++done;
        if (progress) progress(done, total);
      }
      together.clear();
    };
    for (const rosbag::MessageInstance& message : view) {
      const ros::Time now = message.getTime();
      if (!together.empty() && now != together.begin()->second.second.getTime()) play_together();
      if (beat.isZero() || now + ros::Duration(heartbeat) < beat) beat = now;
      if (now > beat + kLongestPause) {
        ros::Time::setNow(beat + kLongestPause);
        listener.onHeartbeat();
        beat = now;
      }
      for (; beat + ros::Duration(heartbeat) <= now; listener.onHeartbeat()) {
        beat += ros::Duration(heartbeat);
        ros::Time::setNow(beat);
      }
      ros::Time::setNow(now);
      const Topic& topic = plays.at(withoutSlash(message.getTopic()));
      together.emplace(topic.rank, std::make_pair(&topic.play, message));
    }
    play_together();
    return total > 0 ? BagSpan{view.getBeginTime(), view.getEndTime()} : BagSpan{};
  } catch (const ConfigurationError&) {
    throw;  // from the listener
  } catch (const std::exception& error) {
    throw std::runtime_error("bag " + path + ": cannot be read: " + error.what() + "; if it was cut off, `rosbag reindex " +
                             (paths.size() > 1 ? "FILE" : path) + "` recovers the complete part");
  }
}

}  // namespace live_stiffness
