#include "ros/pressure_input.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {

ChannelMap makeChannelMap(const NodeParameters& parameters) {
  if (!parameters.channel_of_chamber.empty()) return ChannelMap(parameters.channel_of_chamber);
  return ChannelMap::even(parameters.scene.chamberCount(), parameters.scene.chamberCount());
}

PressureInput::PressureInput(const NodeParameters& parameters)
    : parameters_(parameters),
      channel_map_(makeChannelMap(parameters)),
      status_({"chamber_pressures", "pressures", "channels", "; see ~channel_of_chamber", channel_map_.channelCount(),
               parameters.pressure_timeout}),
      channels_(Pressures::Zero(parameters.pressure_topics.size())),
      arrivals_(parameters.pressure_topics.size()),
      stamps_(parameters.pressure_topics.size()) {}

void PressureInput::setChannels(ChannelMap channels) {
  channel_map_ = std::move(channels);
  status_.setCount(channel_map_.channelCount());
}

std::optional<Parsed<Pressures>> PressureInput::read(const AnyMessage& message) {
  return chamberPressures(readPressures(*message.getConstMessage(), parameters_.pressure_format),
                          message.getPublisherName());
}

std::optional<Parsed<Pressures>> PressureInput::chamberPressures(Parsed<Pressures> channels,
                                                                 const std::string& publisher) {
  if (!status_.accept(channels, publisher)) return std::nullopt;
  channels.value = channel_map_.expand(channels.value);
  return channels;
}

// If one channel is silent or bad, all pressures are stale.
bool PressureInput::isComplete(const ros::Time& now) const {
  return std::all_of(arrivals_.begin(), arrivals_.end(), [&](const ros::Time& arrival) {
    return !arrival.isZero() && std::abs(secondsBetween(arrival, now)) <= parameters_.pressure_timeout;
  });
}

std::optional<Parsed<Pressures>> PressureInput::readChannel(const sensor_msgs::FluidPressure& message, size_t channel) {
  const Parsed<double> pressure = readPressure(message, parameters_.pressure_format);
  Parsed<Pressures> all;
  if (pressure.ok()) {
    const ros::Time now = ros::Time::now();
    channels_[channel] = pressure.value;
    arrivals_[channel] = now;
    stamps_[channel] = pressure.stamp;
    if (!isComplete(now)) return std::nullopt;
    all.value = channels_;
    all.stamp = *std::max_element(stamps_.begin(), stamps_.end());
  } else {
    arrivals_[channel] = ros::Time();
    all.error = parameters_.pressure_topics[channel] + ": " + pressure.error;
  }
  return chamberPressures(std::move(all), "");
}

}  // namespace live_stiffness
