#include "estimation/plausibility.h"

#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

constexpr double kFarthest = 1000.0;       // m; outside the range of any tracker, also if it is millimetres
constexpr double kLargestPressure = 1e8;   // Pa; a glitch beyond would stay in the model of creep for long
constexpr double kLeastPressure = 1e3;     // Pa, of a session in which the robot moves
constexpr double kLongestInterval = 5.0;   // s, between samples
constexpr double kNearAtmosphere = 0.08 * kAtmospherePa;  // weather, altitude and sensors

// In each channel the level that a tenth of the samples stay below.
Pressures lowestTenth(const Recording& recording) {
  Pressures levels(recording.channelCount());
  std::vector<double> values(recording.samples.size());
  for (int k = 0; k < levels.size(); ++k) {
    std::transform(recording.samples.begin(), recording.samples.end(), values.begin(),
                   [k](const RecordedSample& sample) { return sample.pressures[k]; });
    const auto tenth = values.begin() + static_cast<long>(values.size() / 10);
    std::nth_element(values.begin(), tenth, values.end());
    levels[k] = *tenth;
  }
  return levels;
}

// A level at rest of one atmosphere; empty: there is none. Rest is the begin, or whenever pressures are low.
std::string referenceDoubt(const Recording& recording, const Remedies& remedies) {
  const double told = recording.absolute ? kAtmospherePa : 0.0;
  for (const Pressures& level : {restPressures(recording), lowestTenth(recording)}) {
    const auto isNear = [&](double gauge) { return ((level.array() - told - gauge).abs() < kNearAtmosphere).all(); };
    const bool is_above = isNear(kAtmospherePa);
    if (is_above || isNear(-kAtmospherePa))
      return "at rest " + numberText(1e-3 * (level.mean() - told)) + " kPa in all channels: " +
             (is_above ? "told gauge, sent absolute? (" + remedies.absolute
                       : "told absolute, sent gauge? (" + remedies.gauge) + ")";
  }
  return "";
}

double medianInterval(const std::vector<RecordedSample>& samples) {
  std::vector<double> intervals;
  for (size_t i = 1; i < samples.size(); ++i) intervals.push_back(samples[i].time - samples[i - 1].time);
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<long>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

}  // namespace

std::string poseFault(const Vector3& position, const Eigen::Quaterniond& orientation) {
  if (!position.allFinite() || !orientation.coeffs().allFinite())
    return "pose is not finite: the tracker does not see its sensor";
  const double distance = position.norm(), length = orientation.norm();
  if (!(distance <= kFarthest))
    return "position is " + numberText(distance) + " m away: must be within " + numberText(kFarthest) + " m";
  if (length < 1e-6) return "quaternion is zero: the tracker does not see its sensor";
  if (!(std::abs(length - 1.0) <= 0.05)) return "quaternion has length " + numberText(length) + ": must be 1";
  return "";
}

std::string reachFault(double tracker_distance, double base_distance, const Remedies& remedies) {
  if (std::min(tracker_distance, base_distance) <= kPlausibleReach) return "";
  return "position is " + numberText(tracker_distance) + " m away: must be within " + numberText(kPlausibleReach) +
         " m of tracker or base; millimetres? (" + remedies.millimetres + ")";
}

std::string pressureFault(double value, bool is_absolute, double gauge, const Remedies& remedies) {
  if (!std::isfinite(value)) return "is " + numberText(value) + ": must be finite";
  if (is_absolute && value < 0.0)
    return "is " + numberText(value) + ": an absolute pressure must not be negative; is it gauge? (" + remedies.gauge + ")";
  if (!(std::abs(gauge) <= kLargestPressure))
    return "is " + numberText(gauge) + " Pa: must be within " + numberText(kLargestPressure) + " Pa; in another unit?";
  return "";
}

std::vector<std::string> unitWarnings(const Recording& recording, const Remedies& remedies,
                                      std::optional<double> largest_pressure) {
  std::vector<std::string> warnings;
  double motion = 0.0, pressure = 0.0;
  for (const RecordedSample& sample : recording.samples) {
    motion = std::max(motion, (sample.tip_position - recording.samples.front().tip_position).norm());
    pressure = std::max(pressure, sample.pressures.cwiseAbs().maxCoeff());
  }
  if (motion > kPlausibleReach)
    warnings.push_back("the tip moves by " + numberText(motion) + " m: millimetres? (" + remedies.millimetres + ")");
  const std::string reference = referenceDoubt(recording, remedies);
  if (pressure > 0.0 && pressure < std::max(kLeastPressure, 1e-3 * largest_pressure.value_or(0.0)))
    warnings.push_back("no pressure is above " + numberText(pressure) + " Pa: another unit? (" + remedies.pressure_unit + ")");
  else if (!reference.empty())  // numbers of another unit say nothing of it
    warnings.push_back(reference);
  const double interval = medianInterval(recording.samples);
  if (interval > kLongestInterval)
    warnings.push_back("samples are " + numberText(interval) + " s apart: time in milliseconds?" +
                       (remedies.milliseconds.empty() ? "" : " (" + remedies.milliseconds + ")"));
  return warnings;
}

}  // namespace live_stiffness
