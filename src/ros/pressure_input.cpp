#include "ros/pressure_input.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

ChannelMap makeChannelMap(const NodeParameters& parameters) {
  if (!parameters.channel_of_chamber.empty()) return ChannelMap(parameters.channel_of_chamber);
  return ChannelMap::even(parameters.scene.chamberCount(), parameters.scene.chamberCount());
}

ArrayInput::Settings settingsOf(const NodeParameters& parameters, int channel_count) {
  return {"chamber_pressures", "pressures",   "channels", "; see ~channel_of_chamber",
          channel_count,       parameters.pressure_timeout};
}

// Nothing when each channel has a topic of its own.
ArrayInput::Subscribe subscriptionOf(const NodeParameters& parameters) {
  if (!parameters.pressure_topics.empty()) return nullptr;
  const PressureFormat format = parameters.pressure_format;
  return ArrayInput::subscribeTo<ChamberPressures>(
      [format](const auto& message) { return readPressures(message, format); });
}

}  // namespace

PressureInput::PressureInput(ros::NodeHandle node, const NodeParameters& parameters, OnPressures on_pressures,
                             OnFault on_fault)
    : parameters_(parameters),
      channel_map_(makeChannelMap(parameters)),
      input_(
          node, settingsOf(parameters, channel_map_.channelCount()), subscriptionOf(parameters),
          [this, on_pressures = std::move(on_pressures)](const Eigen::VectorXd& channels, const ros::Time& stamp) {
            on_pressures(channel_map_.expand(channels), stamp);
          },
          std::move(on_fault)) {
  const std::vector<std::string>& topics = parameters_.pressure_topics;
  channels_.setZero(topics.size());
  heard_.assign(topics.size(), ros::Time());
  stamps_.assign(topics.size(), ros::Time());
  for (size_t channel = 0; channel < topics.size(); ++channel) {
    const boost::function<void(const sensor_msgs::FluidPressure::ConstPtr&)> callback =
        [this, channel](const sensor_msgs::FluidPressure::ConstPtr& message) { onChannel(message, channel); };
    subscribers_.push_back(node.subscribe<sensor_msgs::FluidPressure>(topics[channel], 10, callback));
  }
}

void PressureInput::adapt() {
  channel_map_ = makeChannelMap(parameters_);
  input_.expect(channel_map_.channelCount());
}

// A channel that is silent or faulty makes the pressures as a whole stale.
bool PressureInput::allHeard(const ros::Time& now) const {
  return std::all_of(heard_.begin(), heard_.end(), [&](const ros::Time& heard) {
    return !heard.isZero() && std::abs((now - heard).toSec()) <= parameters_.pressure_timeout;
  });
}

// One topic per channel: nothing is known unless every channel has just been heard.
void PressureInput::onChannel(const sensor_msgs::FluidPressure::ConstPtr& message, size_t channel) {
  const Reading<double> reading = readPressure(*message, parameters_.pressure_format);
  Reading<Pressures> all;
  if (reading.ok()) {
    const ros::Time now = ros::Time::now();
    channels_[channel] = reading.value;
    heard_[channel] = now;
    all.value = channels_;
    all.stamp = stamps_[channel] = reading.stamp;
    for (const ros::Time& stamp : stamps_) all.stamp = std::max(all.stamp, stamp);
    if (!allHeard(now)) return;
  } else {
    heard_[channel] = ros::Time();
    all.fault = parameters_.pressure_topics[channel] + ": " + reading.fault;
  }
  input_.take(all, "");
}

}  // namespace live_stiffness
