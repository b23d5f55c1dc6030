#include "live_stiffness/estimation/recording.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "csv_table.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

struct Columns {
  int time = 0;
  std::vector<int> pressures, tip;  // tip: position, then quaternion w, x, y, z
  std::vector<int> base, wrench;    // empty: none
  bool absolute = false;
};

// Columns pressure_K_pa or pressure_K_pa_abs for K = 1, 2, ... without gaps.
std::vector<int> findPressures(CsvTable& table, bool& absolute, FaultList& faults) {
  int highest[2] = {0, 0};  // channel of gauge, absolute columns
  for (const std::string& name : table.names()) {
    int channel = 0, end = 0;
    if (std::sscanf(name.c_str(), "pressure_%4d_pa%n", &channel, &end) != 1 || end == 0) continue;
    const std::string suffix = name.substr(end);
    if (suffix.empty() || suffix == "_abs") highest[!suffix.empty()] = std::max(highest[!suffix.empty()], channel);
  }
  if (highest[0] > 0 && highest[1] > 0) faults.add("pressures are both gauge and absolute: must be one of the two");
  if (highest[0] <= 0 && highest[1] <= 0)
    faults.add("pressure columns are missing: must be pressure_1_pa_abs (absolute) or pressure_1_pa (gauge), ...");
  absolute = highest[1] > 0;
  return table.requireAll(numberedColumns("pressure_", absolute ? "_pa_abs" : "_pa", highest[absolute]), faults);
}

// Adds a fault for every column that is missing or repeated, a warning for those not known.
Columns findColumns(CsvTable& table, std::vector<std::string>& warnings, FaultList& faults) {
  Columns columns;
  columns.time = table.require("time_s", faults);
  columns.pressures = findPressures(table, columns.absolute, faults);
  columns.tip = table.requireAll({"tip_x_m", "tip_y_m", "tip_z_m", "tip_qw", "tip_qx", "tip_qy", "tip_qz"}, faults);
  columns.base = table.requireAllOrNone({"base_x_m", "base_y_m", "base_z_m"}, faults);
  columns.wrench = table.requireAllOrNone(
      {"force_x_n", "force_y_n", "force_z_n", "torque_x_nm", "torque_y_nm", "torque_z_nm"}, faults);
  for (int column : table.unknown())
    warnings.push_back("line " + std::to_string(table.line()) + ": column " + std::to_string(column + 1) + ", " +
                       table.names()[column] + ", is not known and ignored");
  return columns;
}

// The sample of the table's present row, or the reason why it is none.
std::optional<RecordedSample> readSample(const CsvTable& table, const Columns& columns, const Recording& so_far,
                                         std::string& reason) {
  RecordedSample sample;
  sample.time = table.number(columns.time, reason);
  sample.pressures = table.numbers(columns.pressures, reason);
  const Eigen::VectorXd tip = table.numbers(columns.tip, reason);
  sample.tip_position = tip.head<3>();
  sample.tip_orientation = Eigen::Quaterniond(tip[3], tip[4], tip[5], tip[6]);
  if (!columns.base.empty()) sample.base_position = table.numbers(columns.base, reason);
  if (!columns.wrench.empty()) sample.tip_wrench = table.numbers(columns.wrench, reason);
  if (!reason.empty()) return std::nullopt;

  // Trackers report a tool that they do not see as a zero quaternion; rounding never gets a real one below 0.5.
  Eigen::Quaterniond& q = sample.tip_orientation;
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
  const Columns columns = findColumns(table, recording.warnings, faults);
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

std::vector<Pressures> gaugePressures(const Recording& recording) {
  constexpr double kRest = 0.5;  // s
  Pressures rest = Pressures::Zero(recording.channelCount());
  if (recording.absolute) {
    int count = 0;
    for (const RecordedSample& sample : recording.samples) {
      if (count > 0 && sample.time - recording.samples.front().time > kRest) break;
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

std::vector<int> quasiStaticSamples(const Recording& recording) {
  constexpr double kChange = 2000.0;                            // Pa
  constexpr double kWindow = 0.25, kBefore = 0.3, kAfter = 1.0;  // s
  const std::vector<RecordedSample>& samples = recording.samples;
  const int count = static_cast<int>(samples.size());
  std::vector<bool> dropped(count, false);
  for (int i = 0; i < count; ++i) {
    const auto isNear = [&](int j) { return j == i + 1 || samples[j].time - samples[i].time <= kWindow + 1e-9; };
    for (int j = i + 1; j < count && isNear(j); ++j) {
      const double change = (samples[j].pressures - samples[i].pressures).cwiseAbs().maxCoeff();
      if (!(change > kChange)) continue;
      int k = i;
      while (k > 0 && samples[k - 1].time >= samples[i].time - kBefore) --k;
      for (; k < count && samples[k].time <= samples[j].time + kAfter; ++k) dropped[k] = true;
    }
  }
  std::vector<int> kept;
  for (int k = 0; k < count; ++k)
    if (!dropped[k]) kept.push_back(k);
  return kept;
}

bool isUnloaded(const RecordedSample& sample) {
  return !sample.tip_wrench || linear(*sample.tip_wrench).norm() < 0.06;
}

}  // namespace live_stiffness
