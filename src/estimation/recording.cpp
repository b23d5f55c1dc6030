#include "live_stiffness/estimation/recording.h"

#include <array>
#include <sstream>

#include "live_stiffness/checks.h"
#include "estimation/recording_columns.h"

namespace live_stiffness {
namespace {

// The sample of the table's present row, or the reason why it is none.
std::optional<RecordedSample> readSample(const CsvTable& table, const RecordingColumns& columns, const Recording& so_far,
                                         std::string& reason) {
  const auto number = [&](int column) { return table.number(column, reason); };
  const auto vector = [&](const std::array<int, 3>& column) {
    return Vector3(number(column[0]), number(column[1]), number(column[2]));
  };
  RecordedSample sample;
  sample.time = number(columns.time);
  sample.pressures.resize(columns.pressures.size());
  for (size_t k = 0; k < columns.pressures.size(); ++k) sample.pressures[k] = number(columns.pressures[k]);
  if (columns.base) sample.base_position = vector(*columns.base);
  sample.tip_position = vector(columns.tip_position);
  Eigen::Quaterniond& q = sample.tip_orientation;
  q.w() = number(columns.tip_orientation[0]);
  q.x() = number(columns.tip_orientation[1]);
  q.y() = number(columns.tip_orientation[2]);
  q.z() = number(columns.tip_orientation[3]);
  if (columns.force) {
    sample.tip_wrench.emplace();
    linear(*sample.tip_wrench) = vector(*columns.force);
    angular(*sample.tip_wrench) = vector(*columns.torque);
  }
  if (!reason.empty()) return std::nullopt;

  // Trackers report a tool that they do not see as a zero quaternion; rounding never gets a real one below 0.5.
  if (!(q.norm() > 0.5 && q.norm() < 2.0)) {
    reason = "quaternion of norm " + numberText(q.norm()) + ": must be near 1";
    return std::nullopt;
  }
  q.normalize();
  if (so_far.samples.empty()) return sample;
  const RecordedSample& last = so_far.samples.back();
  if (!(sample.time > last.time)) {
    reason = "time " + numberText(sample.time) + " s: must be after " + numberText(last.time) + " s of line " +
             std::to_string(last.line);
    return std::nullopt;
  }
  if (q.dot(last.tip_orientation) < 0.0) q.coeffs() = -q.coeffs();
  return sample;
}

}  // namespace

Recording parseRecording(const std::string& csv, const std::string& name) {
  FaultList faults("recording " + name);
  Recording recording;
  recording.name = name;
  std::istringstream text(csv);
  CsvTable table(text);
  const RecordingColumns columns = findColumns(table, recording.warnings, faults);
  faults.throwIfAny();
  recording.absolute = columns.absolute;

  for (std::string reason; table.next(reason);) {
    std::optional<RecordedSample> sample;
    if (reason.empty()) sample = readSample(table, columns, recording, reason);
    if (!sample) {
      recording.warnings.push_back("line " + std::to_string(table.line()) + ": " + reason);
      continue;
    }
    sample->line = static_cast<int>(table.line());
    recording.samples.push_back(std::move(*sample));
  }
  if (recording.samples.empty()) {
    faults.add("no usable line");
    for (const std::string& warning : recording.warnings) faults.add(warning);
  }
  faults.throwIfAny();
  return recording;
}

Recording loadRecording(const std::string& path) {
  return parseRecording(readTextFile("recording", path), path);
}

std::vector<Pressures> gaugePressures(const Recording& recording, double rest_window) {
  Pressures rest = Pressures::Zero(recording.channelCount());
  if (recording.absolute) {
    int count = 0;
    for (const RecordedSample& sample : recording.samples) {
      if (count > 0 && sample.time - recording.samples.front().time > rest_window) break;
      rest += sample.pressures;
      ++count;
    }
    rest /= count;
  }
  std::vector<Pressures> gauge;
  gauge.reserve(recording.samples.size());
  for (const RecordedSample& sample : recording.samples) gauge.push_back(sample.pressures - rest);
  return gauge;
}

std::vector<int> quasiStaticSamples(const Recording& recording, const QuasiStaticRule& rule) {
  const std::vector<RecordedSample>& samples = recording.samples;
  const int count = static_cast<int>(samples.size());
  std::vector<bool> dropped(count, false);
  for (int i = 0; i < count; ++i) {
    const auto isNear = [&](int j) { return j == i + 1 || samples[j].time - samples[i].time <= rule.window + 1e-9; };
    for (int j = i + 1; j < count && isNear(j); ++j) {
      const double change = (samples[j].pressures - samples[i].pressures).cwiseAbs().maxCoeff();
      if (!(change > rule.change)) continue;
      int k = i;
      while (k > 0 && samples[k - 1].time >= samples[i].time - rule.before) --k;
      for (; k < count && samples[k].time <= samples[j].time + rule.after; ++k) dropped[k] = true;
    }
  }
  std::vector<int> kept;
  for (int k = 0; k < count; ++k)
    if (!dropped[k]) kept.push_back(k);
  return kept;
}

bool isUnloaded(const RecordedSample& sample, double force) {
  return !sample.tip_wrench || linear(*sample.tip_wrench).norm() < force;
}

}  // namespace live_stiffness
