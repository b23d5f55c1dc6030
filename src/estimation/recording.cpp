#include "live_stiffness/estimation/recording.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <sstream>

#include "csv_table.h"
#include "estimation/plausibility.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/parameters.h"
#include "units.h"

namespace live_stiffness {
namespace {

const Remedies kRemedies{"name the columns tip_x_mm, tip_y_mm, tip_z_mm", "name the columns pressure_1_kpa, _bar, _mbar or _psi",
                         "name the columns pressure_1_pa, without _abs", "name the columns pressure_1_pa_abs",
                         "name the column time_ms"};

// Columns of one unit.
struct Quantity {
  std::vector<int> columns;
  double unit = 1.0;  // SI value

  Eigen::VectorXd of(CsvTable& table, std::string& reason) const { return unit * table.numbers(columns, reason); }
};

struct Columns {
  Quantity time, pressures, tip, base, wrench;   // positions of tip and base; base and wrench may have none
  std::vector<int> tip_rotation, base_rotation;  // w, x, y, z; or none
  bool absolute = false;
};

// Columns pressure_K_UNIT or pressure_K_UNIT_abs for K = 1, 2, ... without gaps.
Quantity findPressures(CsvTable& table, bool& absolute, FaultList& faults) {
  std::vector<std::string> kinds;  // all, such as "_pa_abs"
  Quantity pressures;
  for (std::string unit : kPressureUnit.choices)
    for (const char* reference : {"", "_abs"}) {
      const double pascals = pascalsPerUnit(unit);
      std::string suffix = "_" + unit + reference;
      std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return std::tolower(c); });
      int highest = 0;
      for (const std::string& name : table.names()) {
        int channel = 0, end = 0;
        if (std::sscanf(name.c_str(), "pressure_%4d%n", &channel, &end) == 1 && name.substr(end) == suffix)
          highest = std::max(highest, channel);
      }
      if (highest <= 0) continue;
      kinds.push_back(suffix);
      absolute = *reference != '\0';
      pressures = {table.requireAll(numberedColumns("pressure_", suffix, highest), faults), pascals};
    }
  if (kinds.empty())
    faults.add("pressure columns are missing: must be pressure_1_pa_abs (absolute) or pressure_1_pa (gauge), ...");
  if (kinds.size() > 1)
    faults.add("pressures end in " + oneLine(kinds) + ": must be of one unit, and all gauge or all absolute (_abs)");
  return pressures;
}

// NAME_x_m to NAME_z_m, or in mm; none if there is not one of them.
Quantity findPosition(CsvTable& table, const std::string& name, FaultList& faults) {
  for (const std::string& unit : kPositionUnit.choices) {
    const std::vector<int> columns =
        table.requireAllOrNone({name + "_x_" + unit, name + "_y_" + unit, name + "_z_" + unit}, faults);
    if (!columns.empty()) return {columns, metresPerUnit(unit)};
  }
  return {};
}

// Adds a fault for every column that is missing or repeated, a warning for those not known.
Columns findColumns(CsvTable& table, std::vector<std::string>& warnings, FaultList& faults) {
  Columns columns;
  columns.time = table.find("time_ms") ? Quantity{{table.require("time_ms", faults)}, 1e-3}
                                       : Quantity{{table.require("time_s", faults)}, 1.0};
  columns.pressures = findPressures(table, columns.absolute, faults);
  columns.tip = findPosition(table, "tip", faults);
  if (columns.tip.columns.empty()) table.requireAll({"tip_x_m", "tip_y_m", "tip_z_m"}, faults);
  columns.tip_rotation = table.requireAllOrNone({"tip_qw", "tip_qx", "tip_qy", "tip_qz"}, faults);
  columns.base = findPosition(table, "base", faults);
  columns.base_rotation = table.requireAllOrNone({"base_qw", "base_qx", "base_qy", "base_qz"}, faults);
  columns.wrench.columns = table.requireAllOrNone(
      {"force_x_n", "force_y_n", "force_z_n", "torque_x_nm", "torque_y_nm", "torque_z_nm"}, faults);
  if (!faults.empty()) faults.add("the columns of the header are: " + oneLine(table.names()));
  if (!table.note().empty()) warnings.push_back(table.note());
  if (columns.tip_rotation.empty()) warnings.push_back("no columns tip_qw to tip_qz: positions only");
  for (int column : table.unknown())
    warnings.push_back("column " + std::to_string(column + 1) + ", " + table.names()[column] + ", is not known and ignored");
  return columns;
}

// Lines that are left out, by kind of reason.
class LeftOut {
  struct Kind {
    std::string name;
    long count, line;
    std::string reason;  // of the first
  };

 public:
  void add(long line, const std::string& reason) {
    // Texts of a kind differ in what lies between their first and last number, or quoted text, only.
    const char* const values = "0123456789'";
    const size_t first = reason.find_first_of(values), last = reason.find_last_of(values);
    const std::string kind = first == std::string::npos ? reason : reason.substr(0, first) + reason.substr(last + 1);
    const auto same = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& other) { return other.name == kind; });
    if (same == kinds_.end()) kinds_.push_back({kind, 1, line, reason});
    else ++same->count;
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const Kind& kind : kinds_)
      texts.push_back((kind.count == 1 ? "1 line left out, line " : std::to_string(kind.count) + " lines left out, first line ") +
                      std::to_string(kind.line) + ": " + kind.reason);
    return texts;
  }

 private:
  std::vector<Kind> kinds_;
};

Eigen::Quaterniond readRotation(CsvTable& table, const std::vector<int>& columns, std::string& reason) {
  if (columns.empty()) return Eigen::Quaterniond::Identity();
  const Eigen::VectorXd q = table.numbers(columns, reason);
  return {q[0], q[1], q[2], q[3]};
}

// Why the measurement of a new sample cannot be that of a robot; empty: it can.
std::string faultOf(const RecordedSample& sample, bool absolute) {
  const std::string fault = poseFault(sample.tip_position, sample.tip_orientation);
  if (!fault.empty()) return fault;
  const Vector3 base = sample.base_position.value_or(Vector3::Zero());
  const std::string base_fault = poseFault(base, sample.base_orientation.value_or(Eigen::Quaterniond::Identity()));
  if (!base_fault.empty()) return "base sensor: " + base_fault;
  const std::string reach_fault = reachFault(sample.tip_position.norm(), (sample.tip_position - base).norm(), kRemedies);
  if (!reach_fault.empty()) return reach_fault;
  for (int k = 0; k < sample.pressures.size(); ++k) {
    const double pressure = sample.pressures[k];
    const std::string pressure_fault =
        pressureFault(pressure, absolute, pressure - (absolute ? kAtmospherePa : 0.0), kRemedies);
    if (!pressure_fault.empty()) return "pressure of channel " + std::to_string(k + 1) + " " + pressure_fault;
  }
  return "";
}

// The sample of the table's present row, or the reason why it is none.
std::optional<RecordedSample> readSample(CsvTable& table, const Columns& columns, const Recording& so_far,
                                         std::string& reason) {
  RecordedSample sample;
  sample.line = static_cast<int>(table.line());
  sample.time = columns.time.of(table, reason)[0];
  sample.pressures = columns.pressures.of(table, reason);
  sample.tip_position = columns.tip.of(table, reason);
  sample.tip_orientation = readRotation(table, columns.tip_rotation, reason);
  if (!columns.base.columns.empty()) sample.base_position = columns.base.of(table, reason);
  if (!columns.base_rotation.empty()) sample.base_orientation = readRotation(table, columns.base_rotation, reason);
  if (!columns.wrench.columns.empty()) sample.tip_wrench = columns.wrench.of(table, reason);
  if (reason.empty()) reason = faultOf(sample, columns.absolute);
  if (!reason.empty()) return std::nullopt;

  Eigen::Quaterniond& q = sample.tip_orientation;
  q.normalize();
  if (sample.base_orientation) sample.base_orientation->normalize();
  if (so_far.samples.empty()) return sample;
  const RecordedSample& last = so_far.samples.back();
  const double step = sample.time - last.time;
  if (!(step > 0.0)) {
    reason = step == 0.0 ? "time is that of line " + std::to_string(last.line) + ": must increase; write it with more digits"
                         : "time goes back by " + numberText(-step) + " s: must increase; sort the lines by time";
    return std::nullopt;
  }
  if (q.dot(last.tip_orientation) < 0.0) q.coeffs() = -q.coeffs();
  if (sample.tip_position == last.tip_position && q.coeffs() == last.tip_orientation.coeffs())
    sample.unchanged_for = last.unchanged_for + step;
  return sample;
}

// Of a file that is no text at all.
std::string otherFormat(const std::string& bytes) {
  if (bytes.compare(0, 7, "#ROSBAG") == 0) return "is a bag: must be CSV";
  if (bytes.compare(0, 4, "PK\x03\x04") == 0) return "is a workbook or another archive: must be CSV; export it as that";
  return "";
}

}  // namespace

Recording parseRecording(const std::string& csv, const std::string& name, std::optional<double> largest_pressure) {
  FaultList faults("recording " + name);
  const std::string other = otherFormat(csv);
  if (!other.empty()) faults.add(other);
  faults.throwIfAny();
  Recording recording;
  recording.name = name;
  std::istringstream text(csv);
  CsvTable table(text);
  const Columns columns = findColumns(table, recording.warnings, faults);
  faults.throwIfAny();
  recording.absolute = columns.absolute;
  if (columns.tip_rotation.empty()) recording.measures = TrackerMeasures::kPosition;

  LeftOut left_out;
  for (std::string reason; table.next(reason);) {
    std::optional<RecordedSample> sample;
    if (reason.empty()) sample = readSample(table, columns, recording, reason);
    if (sample) recording.samples.push_back(std::move(*sample));
    else left_out.add(table.line(), reason);
  }
  std::vector<std::string>& warnings = recording.warnings;
  for (const std::string& reason : left_out.texts()) warnings.push_back(reason);
  if (recording.samples.empty()) {
    faults.add("no usable line");
    for (const std::string& warning : warnings) faults.add(warning);
  }
  faults.throwIfAny();
  for (const std::string& warning : unitWarnings(recording, kRemedies, largest_pressure)) warnings.push_back(warning);
  return recording;
}

Recording loadRecording(const std::string& path, std::optional<double> largest_pressure) {
  return parseRecording(readTextFile("recording", path), path, largest_pressure);
}

Pressures restPressures(const Recording& recording) {
  constexpr double kRest = 0.5;  // s
  Pressures sum = Pressures::Zero(recording.channelCount());
  int count = 0;
  for (const RecordedSample& sample : recording.samples) {
    if (count > 0 && sample.time - recording.samples.front().time > kRest) break;
    sum += sample.pressures;
    ++count;
  }
  return sum / count;
}

std::vector<Pressures> gaugePressures(const Recording& recording) {
  Pressures rest = Pressures::Zero(recording.channelCount());
  if (recording.absolute) rest = restPressures(recording);
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
