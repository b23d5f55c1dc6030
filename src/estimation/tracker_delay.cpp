#include "estimation/tracker_delay.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "estimation/interpolation.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

std::vector<double> timesOf(const Recording& recording) {
  std::vector<double> times;
  for (const RecordedSample& sample : recording.samples) times.push_back(sample.time);
  return times;
}

// Minimum of a function of the delay: by steps finer than the time between samples, then by golden section around the best.
template <class Cost>
double bestDelay(const Cost& costAt) {
  constexpr double kStep = 0.01, kGolden = 0.6180339887498949, kEnough = 1e-5;  // s
  double best = 0.0, least = costAt(0.0);
  const int steps = static_cast<int>(std::round(TrackerDelay::kLargest / kStep));
  for (int i = -steps; i <= steps; ++i) {
    const double delay = i * kStep, cost = costAt(delay);
    if (cost < least) least = cost, best = delay;
  }
  double low = best - kStep, high = best + kStep;
  while (high - low > kEnough) {
    const double span = high - low, left = high - kGolden * span, right = low + kGolden * span;
    if (costAt(left) < costAt(right)) high = right;
    else low = left;
  }
  return 0.5 * (low + high);
}

}  // namespace

Recording withTrackerDelay(const Recording& recording, double delay) {
  Recording result = recording;
  if (delay == 0.0) return result;
  const std::vector<double> times = timesOf(recording);
  std::vector<Pressures> pressures;
  std::vector<Wrench> wrenches;
  for (const RecordedSample& sample : recording.samples) {
    pressures.push_back(sample.pressures);
    if (sample.tip_wrench) wrenches.push_back(*sample.tip_wrench);
  }
  for (RecordedSample& sample : result.samples) {
    sample.pressures = interpolated(times, pressures, sample.time - delay);
    if (wrenches.size() == times.size()) sample.tip_wrench = interpolated(times, wrenches, sample.time - delay);
  }
  return result;
}

TrackerDelay fitTrackerDelay(const Recording& recording, const std::vector<Vector3>& predicted) {
  constexpr double kCorrelation = 1.0;      // s that an error lasts
  constexpr double kDifference = 0.01;      // s, in both directions, for the predicted speed: less than between samples
  constexpr double kLeastVariance = 9e-10;  // m^2 an axis: a simulation without noise is not better than a sample's rounding
  const std::vector<double> times = timesOf(recording);
  const auto predictedAt = [&](double time) { return interpolated(times, predicted, time); };
  std::vector<RecordedSample> free;
  std::copy_if(recording.samples.begin(), recording.samples.end(), std::back_inserter(free), isUnloaded);
  const auto meanOf = [&](auto term) {
    double sum = 0.0;
    for (const RecordedSample& sample : free) sum += term(sample);
    return sum / static_cast<double>(free.size());
  };
  const auto meanSquare = [&](double delay) {
    return meanOf([&](const RecordedSample& sample) {
      return (predictedAt(sample.time - delay) - sample.tip_position).squaredNorm();
    });
  };
  TrackerDelay result;
  result.rms_before = result.rms = std::sqrt(meanSquare(0.0));
  const double delay = bestDelay(meanSquare), mean_square = meanSquare(delay);
  const double squared_speed = meanOf([&](const RecordedSample& sample) {
    const double at = sample.time - delay;
    return ((predictedAt(at + kDifference) - predictedAt(at - kDifference)) / (2.0 * kDifference)).squaredNorm();
  });
  const double sample_time = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double sharing = std::max(1.0, kCorrelation / sample_time);  // samples that share their error
  const double variance = std::max(mean_square / 3.0, kLeastVariance);
  result.standard_error = std::sqrt(variance * sharing / (squared_speed * static_cast<double>(free.size())));
  result.determined =
      result.standard_error < TrackerDelay::kLargestError && std::abs(delay) < TrackerDelay::kLargest - 1e-9;
  if (!result.determined) return result;
  result.delay = delay;
  result.rms = std::sqrt(mean_square);
  return result;
}

std::string TrackerDelay::text() const {
  if (!determined)
    return "tracker delay: NOT determined by these data (+- " + numberText(standard_error) +
           " s): move the robot quickly; 0 is kept";
  return "tracker delay: " + numberText(1e3 * delay) + " +- " + numberText(1e3 * standard_error) +
         " ms; RMS distance from the model " + numberText(1e3 * rms_before) + " mm without, " + numberText(1e3 * rms) +
         " mm with it";
}

}  // namespace live_stiffness
