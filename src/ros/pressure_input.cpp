#include "live_stiffness/ros/pressure_input.h"

#include <algorithm>

namespace live_stiffness {
namespace {

using diagnostic_msgs::DiagnosticStatus;

ChannelMap makeChannelMap(const NodeParameters& parameters) {
  if (!parameters.channel_of_chamber.empty()) return ChannelMap(parameters.channel_of_chamber);
  return ChannelMap::even(parameters.scene.chamberCount(), parameters.scene.chamberCount());
}

}  // namespace

PressureInput::PressureInput(ros::NodeHandle node, const NodeParameters& parameters, OnPressures on_pressures,
                             OnFault on_fault)
    : node_(std::move(node)),
      parameters_(parameters),
      on_pressures_(std::move(on_pressures)),
      on_fault_(std::move(on_fault)),
      channel_map_(makeChannelMap(parameters)),
      watch_("chamber_pressures") {
  subscribe();
}

void PressureInput::subscribe() {
  const std::vector<std::string>& topics = parameters_.pressure_topics;
  subscribers_.clear();
  if (topics.empty()) {
    subscribers_.push_back(node_.subscribe("chamber_pressures", 10, &PressureInput::onMessage, this));
    return;
  }
  channels_.setZero(topics.size());
  heard_.assign(topics.size(), ros::Time());
  for (size_t channel = 0; channel < topics.size(); ++channel) {
    const boost::function<void(const sensor_msgs::FluidPressure::ConstPtr&)> callback =
        [this, channel](const sensor_msgs::FluidPressure::ConstPtr& message) { onChannel(message, channel); };
    subscribers_.push_back(node_.subscribe<sensor_msgs::FluidPressure>(topics[channel], 10, callback));
  }
}

void PressureInput::tend() {
  if (parameters_.pressure_topics.empty() && isStale() && subscribers_.front().getNumPublishers() == 0) subscribe();
}

// A channel that is silent or faulty makes the pressures as a whole stale.
bool PressureInput::allHeard(const ros::Time& now) const {
  return std::all_of(heard_.begin(), heard_.end(), [&](const ros::Time& heard) {
    return !heard.isZero() && (now - heard).toSec() <= parameters_.pressure_timeout;
  });
}

void PressureInput::onMessage(const topic_tools::ShapeShifter::ConstPtr& message) {
  take(readPressures(*message, parameters_.pressure_format));
}

// One topic per channel: nothing is known unless every channel has just been heard.
void PressureInput::onChannel(const sensor_msgs::FluidPressure::ConstPtr& message, size_t channel) {
  const Reading<double> reading = readPressure(*message, parameters_.pressure_format);
  Reading<Pressures> all;
  all.stamp = reading.stamp;
  if (reading.ok()) {
    const ros::Time now = ros::Time::now();
    channels_[channel] = reading.value;
    heard_[channel] = now;
    all.value = channels_;
    if (!allHeard(now)) return;
  } else {
    heard_[channel] = ros::Time();
    all.fault = parameters_.pressure_topics[channel] + ": " + reading.fault;
  }
  take(all);
}

void PressureInput::take(const Reading<Pressures>& channels) {
  std::string fault = channels.fault;
  if (fault.empty() && channels.value.size() != channel_map_.channelCount())
    fault = std::to_string(channels.value.size()) + " channels: must be " +
            std::to_string(channel_map_.channelCount()) + "; see ~channel_of_chamber";
  if (!fault.empty()) {
    watch_.reject(fault);
    on_fault_(fault);
    return;
  }
  const ros::Time now = ros::Time::now();
  const ros::Time stamp = watch_.stampFor(channels.stamp, now);
  watch_.accept(now);
  on_pressures_(channel_map_.expand(channels.value), stamp);
}

bool PressureInput::isStale() const { return watch_.age(ros::Time::now()) > parameters_.pressure_timeout; }

void PressureInput::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (!watch_.currentFault().empty())
    status.summary(DiagnosticStatus::ERROR, watch_.currentFault());
  else if (!watch_.everAccepted())
    status.summary(DiagnosticStatus::ERROR, "no pressures received yet");
  else if (isStale())
    status.summaryf(DiagnosticStatus::ERROR, "pressures are stale: %.1f s old", watch_.age(ros::Time::now()));
  else if (watch_.foreignStamps() > 0)
    status.summary(DiagnosticStatus::WARN, "stamps are not in ROS time; the time of arrival is used");
  else
    status.summary(DiagnosticStatus::OK, "ok");
  watch_.report(status);
}

}  // namespace live_stiffness
