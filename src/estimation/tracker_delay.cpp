#include "estimation/tracker_delay.h"

#include <cmath>

#include "live_stiffness/checks.h"
#include "estimation/interpolation.h"

namespace live_stiffness {
namespace {

std::vector<double> timesOf(const Recording& recording) {
  std::vector<double> times;
  for (const RecordedSample& sample : recording.samples) times.push_back(sample.time);
  return times;
}

struct Series {
  const std::vector<double>& times;
  const std::vector<Vector3>& predicted;
  const std::vector<Vector3>& measured;
  const std::vector<bool>& used;

  Vector3 predictedAt(double time) const { return valueAt(predicted, placeIn(times, time)); }
  double meanSquare(double delay) const {
    double sum = 0.0;
    int count = 0;
    for (size_t i = 0; i < times.size(); ++i) {
      if (!used[i]) continue;
      sum += (predictedAt(times[i] - delay) - measured[i]).squaredNorm();
      ++count;
    }
    return sum / count;
  }
  // Sum of squares of the predicted speed, m^2/s^2, and the number of used samples.
  double squaredSpeeds(double delay, int& count) const {
    constexpr double kStep = 0.01;  // s, in both directions: less than the time between samples
    double sum = 0.0;
    count = 0;
    for (size_t i = 0; i < times.size(); ++i) {
      if (!used[i]) continue;
      const double at = times[i] - delay;
      sum += (predictedAt(at + kStep) - predictedAt(at - kStep)).squaredNorm() / (4.0 * kStep * kStep);
      ++count;
    }
    return sum;
  }
};

// Minimum of the mean square: by steps finer than the time between samples, then by golden section around the best.
double bestDelay(const Series& series) {
  constexpr double kStep = 0.01, kGolden = 0.6180339887498949, kEnough = 1e-5;  // s
  double best = 0.0, least = series.meanSquare(0.0);
  const int steps = static_cast<int>(std::round(TrackerDelay::kLargest / kStep));
  for (int i = -steps; i <= steps; ++i) {
    const double delay = i * kStep, cost = series.meanSquare(delay);
    if (cost < least) least = cost, best = delay;
  }
  double low = best - kStep, high = best + kStep;
  while (high - low > kEnough) {
    const double span = high - low, left = high - kGolden * span, right = low + kGolden * span;
    if (series.meanSquare(left) < series.meanSquare(right)) high = right;
    else low = left;
  }
  return 0.5 * (low + high);
}

void check(const Series& series) {
  FaultList faults("tracker delay");
  const size_t count = series.times.size();
  if (count < 3) faults.add(std::to_string(count) + " samples: must be at least 3");
  if (series.predicted.size() != count || series.measured.size() != count || series.used.size() != count)
    faults.add("times, predicted, measured and used: must have the same number of entries");
  faults.throwIfAny();
  long usable = 0;
  for (size_t i = 0; i < count; ++i) {
    if (!std::isfinite(series.times[i]) || !series.predicted[i].allFinite() || !series.measured[i].allFinite())
      faults.add("sample " + std::to_string(i) + " is not finite");
    usable += series.used[i];
  }
  if (usable < 3) faults.add(std::to_string(usable) + " samples in use: must be at least 3");
  faults.throwIfAny();
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
    const TimePlace place = placeIn(times, sample.time - delay);
    sample.pressures = valueAt(pressures, place);
    if (wrenches.size() == times.size()) sample.tip_wrench = valueAt(wrenches, place);
  }
  return result;
}

TrackerDelay fitTrackerDelay(const std::vector<double>& times, const std::vector<Vector3>& predicted,
                             const std::vector<Vector3>& measured, const std::vector<bool>& used, double correlation) {
  const Series series{times, predicted, measured, used};
  check(series);
  TrackerDelay result;
  result.rms_before = result.rms = std::sqrt(series.meanSquare(0.0));
  const double delay = bestDelay(series);
  const double mean_square = series.meanSquare(delay);
  int count = 0;
  const double squared_speeds = series.squaredSpeeds(delay, count);
  const double sample_time = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double sharing = std::max(1.0, correlation / sample_time);  // samples that share their error
  // At least this noise, so that the error of a simulation without noise is not smaller than the rounding of a sample.
  constexpr double kLeast = 3e-5;  // m
  const double variance = std::max(mean_square / 3.0, kLeast * kLeast);  // per axis
  result.standard_error = squared_speeds > 0.0 ? std::sqrt(variance * sharing / squared_speeds) : kInfinity;
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
