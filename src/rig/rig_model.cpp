#include "rig/rig_model.h"

#include <Eigen/LU>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

constexpr int kErrorComponents = 3;
constexpr double kSlowestError = 60.0;  // s, period of the slowest of them

void checkPose(const std::string& name, const Pose& X, FaultList& faults) {
  constexpr double kOrthonormal = 1e-6;
  if (!X.p.allFinite()) faults.add(name + ".position_m: must be finite");
  const bool is_rotation = X.R.allFinite() && (X.R.transpose() * X.R - Matrix3::Identity()).norm() < kOrthonormal &&
                           X.R.determinant() > 0.0;
  if (!is_rotation) faults.add(name + ": its orientation must be a rotation");
}

// The map, after a look at everything, so that all faults come out together.
ChannelMap checkedChannelMap(const Scene& scene, const RigOptions& options) {
  FaultList faults("rig");
  faults.checkAll(options);
  faults.check("tracker_delay_s", options.registration.tracker_delay, {0.0, Registration::kLargestDelay});
  checkPose("base_in_tracker", options.registration.X_AB, faults);
  checkPose("sensor_on_tip", options.registration.X_TS, faults);
  options.contact.check(faults);
  if (scene.segmentCount() == 0) faults.add("chain: must hold at least one segment");
  if (scene.chamberCount() == 0) faults.add("chain: must hold at least one chamber");
  std::vector<int> channels = options.channel_of_chamber;
  if (channels.empty()) {
    channels.resize(scene.chamberCount());
    std::iota(channels.begin(), channels.end(), 0);
  }
  if (static_cast<int>(channels.size()) != scene.chamberCount())
    faults.add("channel_of_chamber has " + std::to_string(channels.size()) + " entries: must be " +
               std::to_string(scene.chamberCount()) + ", one per chamber");
  std::optional<ChannelMap> map;
  try {
    if (!channels.empty()) map.emplace(channels);
  } catch (const ConfigurationError& error) {
    for (const std::string& fault : error.faults()) faults.add(fault);
  }
  // The section's range ends at a stretch, and nothing stretches more than every chamber at its highest.
  const double highest = options.program.amplitude + options.regulator_error;
  if (faults.empty() && !FineRobot(scene).inRange(Pressures::Constant(scene.chamberCount(), highest)))
    faults.add("amplitude_pa + regulator_error_pa = " + numberText(highest) +
               ": in all chambers at once leaves a section without solid area; lower it");
  faults.throwIfAny();
  return *map;
}

Vector3 whiteNoise(std::mt19937_64& random, double rms_magnitude) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const double x = normal(random), y = normal(random), z = normal(random);
  return rms_magnitude / std::sqrt(3.0) * Vector3(x, y, z);
}

}  // namespace

RigModel::RigModel(Scene scene, const RigOptions& options)
    : options_(options),
      channel_map_(checkedChannelMap(scene, options)),
      random_(options.seed),
      program_(channel_map_.channelCount(), options.program, random_()),
      robot_(std::move(scene)),
      regulator_(channel_map_.channelCount(), options.regulator_time_constant),
      creep_(channel_map_.chamberCount(), options.creep_time_constant) {
  std::uniform_real_distribution<double> phase(0.0, 2.0 * kPi);
  for (int channel = 0; channel < channel_map_.channelCount(); ++channel) {
    const double a = phase(random_), b = phase(random_), c = phase(random_);
    error_phases_.emplace_back(a, b, c);
  }
}

// Sines of one, two and three times the slowest frequency, a third of the bound each.
Pressures RigModel::slowError(double time) const {
  Pressures error = Pressures::Zero(channel_map_.channelCount());
  const double slowest = 2.0 * kPi * std::fmod(time / kSlowestError, 1.0);
  for (int channel = 0; channel < error.size(); ++channel)
    for (int k = 0; k < kErrorComponents; ++k)
      error[channel] +=
          options_.regulator_error / kErrorComponents * std::sin((k + 1) * slowest + error_phases_[channel][k]);
  return error;
}

std::optional<Pose> RigModel::track(double time) {
  if (time < drop_out_until_) return std::nullopt;
  if (std::uniform_real_distribution<double>(0.0, 1.0)(random_) < options_.drop_out_probability) {
    drop_out_until_ = time + options_.drop_out_duration;
    return std::nullopt;
  }
  const Registration& registration = options_.registration;
  Pose X_AS = registration.sensorPose(history_.at(time - registration.tracker_delay).X_BT);
  X_AS.p += whiteNoise(random_, options_.position_noise);
  X_AS.R *= expSo3(whiteNoise(random_, options_.rotation_noise));
  return X_AS;
}

RigSample RigModel::step(double time) {
  if (!std::isfinite(time) || time < time_)
    throw std::invalid_argument("time " + numberText(time) + " s: must be finite and at least " + numberText(time_));
  const double elapsed = time - time_;

  RigSample sample;
  sample.time = time;
  sample.command = program_.at(time);
  sample.measured_channels = regulator_.update(sample.command, elapsed);
  sample.measured_chambers = channel_map_.expand(sample.measured_channels);
  const Pressures actual = (sample.measured_channels + slowError(time)).cwiseMax(0.0);
  sample.actual_chambers = channel_map_.expand(actual);
  sample.effective_chambers = (1.0 - options_.creep_fraction) * sample.actual_chambers +
                              options_.creep_fraction * creep_.update(sample.actual_chambers, elapsed);
  sample.contact_wrench = options_.contact.at(time);
  const std::optional<Pose> X_BT = robot_.solve(sample.effective_chambers, sample.contact_wrench);
  if (!X_BT) throw std::runtime_error("the simulated robot finds no equilibrium at " + numberText(time) + " s");
  sample.X_BT = *X_BT;
  history_.add({time, sample.effective_chambers, sample.X_BT});
  sample.X_AS = track(time);
  time_ = time;
  return sample;
}

}  // namespace live_stiffness
