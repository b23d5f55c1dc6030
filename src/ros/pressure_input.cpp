#include "ros/pressure_input.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {

PressureInput::PressureInput(const InputParameters& parameters, const Scene* scene)
    : parameters_(parameters),
      status_({"chamber_pressures", "pressures", "channels", "; see channel_of_chamber", 0, parameters.pressure_timeout}),
      levels_(0.0),
      channels_(Pressures::Zero(static_cast<long>(parameters.pressure_topics.size()))),
      arrivals_(parameters.pressure_topics.size()),
      stamps_(parameters.pressure_topics.size()) {
  setScene(scene != nullptr ? *scene : Scene());
}

void PressureInput::setScene(const Scene& scene) {
  channel_map_.reset();
  if (!parameters_.channel_of_chamber.empty()) channel_map_ = ChannelMap(parameters_.channel_of_chamber);
  status_.setCount(channel_map_ ? channel_map_->channelCount() : scene.chamberCount(), channel_map_.has_value());
  levels_ = PressureLevels(fullRange(scene));
}

std::optional<Parsed<Pressures>> PressureInput::read(const topic_tools::ShapeShifter& message, const std::string& publisher) {
  return accepted(readPressures(message, parameters_.pressure_format), publisher);
}

std::optional<Parsed<Pressures>> PressureInput::accepted(Parsed<Pressures> channels, const std::string& publisher) {
  if (!status_.accept(channels, publisher)) return std::nullopt;
  levels_.add(channels.value);
  constexpr long kEvery = 20;  // a look at the levels costs more than a message
  if (first_doubt_.empty() && status_.accepted() % kEvery == 0) first_doubt_ = levels_.doubt();
  return channels;
}

// If one channel is silent or bad, all pressures are stale.
std::string PressureInput::silentChannel() const {
  const ros::Time now = ros::Time::now();
  for (size_t channel = 0; channel < arrivals_.size(); ++channel) {
    const double age = std::abs(secondsBetween(arrivals_[channel], now));
    if (arrivals_[channel].isZero()) return parameters_.pressure_topics[channel] + " has sent nothing that can be used";
    if (age > parameters_.pressure_timeout)
      return parameters_.pressure_topics[channel] + " is silent for " + numberText(age) + " s";
  }
  return "";
}

std::optional<Parsed<Pressures>> PressureInput::readChannel(const sensor_msgs::FluidPressure& message, size_t channel) {
  const Parsed<double> pressure = readPressure(message, parameters_.pressure_format);
  Parsed<Pressures> all;
  if (pressure.ok()) {
    channels_[static_cast<long>(channel)] = pressure.value;
    arrivals_[channel] = ros::Time::now();
    stamps_[channel] = pressure.stamp;
    const std::string silent = silentChannel();
    if (!silent.empty()) {
      if (first_silence_.empty() && status_.accepted() > 0) first_silence_ = silent;
      return std::nullopt;
    }
    all.value = channels_;
    all.stamp = *std::max_element(stamps_.begin(), stamps_.end());
  } else {
    arrivals_[channel] = ros::Time();
    all.error = parameters_.pressure_topics[channel] + ": " + pressure.error;
  }
  return accepted(std::move(all), "");
}

void PressureInput::diagnose(const std::string& solver_error, diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::string silent = silentChannel();
  status_.diagnose(solver_error, silent.empty() ? "" : ": " + silent, levels_.doubt(), status);
}

}  // namespace live_stiffness
