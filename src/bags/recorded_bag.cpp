#include "bags/recorded_bag.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>

#include "estimation/plausibility.h"
#include "live_stiffness/checks.h"
#include "parameter_reader.h"
#include "ros/pressure_input.h"
#include "ros/tracker_input.h"

namespace live_stiffness {
namespace {

struct Seen {
  Pose X_AS;
  double unchanged_for = 0.0;  // s
};

// What can be used of the topics, by its stamps.
class Tracks : public BagListener {
 public:
  explicit Tracks(const InputParameters& parameters)
      : pressure_input(parameters, nullptr), tracker_input(parameters, registration_) {}

  void onPressures(const topic_tools::ShapeShifter& message) override { keep(pressure_input.read(message, "")); }
  void onChannelPressure(const sensor_msgs::FluidPressure& message, size_t channel) override {
    keep(pressure_input.readChannel(message, channel));
  }
  void onPose(const topic_tools::ShapeShifter& message) override { keep(tracker_input.read(message)); }
  void onTf(const tf2_msgs::TFMessage& transforms, bool is_static) override {
    keep(tracker_input.read(transforms, is_static));
  }
  void onWrench(const geometry_msgs::WrenchStamped& message) override {
    const std::string frame = withoutSlash(message.header.frame_id);
    if (wrenches.empty()) wrench_frame = frame;
    const Parsed<Wrench> reading = readWrench(message, {wrench_frame, ""}, nullptr);  // a recording keeps the sensor's axes
    if (!reading.ok()) return wrench_status.reject(reading.error);
    if (const auto stamp = wrench_status.accept(reading.stamp)) wrenches[stamp->toSec()] = reading.value;
  }
  void onHeartbeat() override {
    pressure_input.status().checkClock();
    tracker_input.status().checkClock();
  }
  void onForeign(const std::string& topic, const std::string& type) override {
    ++foreign[topic + " of type " + type];
  }

  std::map<double, Pressures> pressures;  // of channels; empty: not known from then on
  std::map<double, Seen> poses;
  std::map<double, Wrench> wrenches;
  std::string wrench_frame;
  std::map<std::string, long> foreign;  // messages of a type that nothing reads

 private:
  const Registration registration_;  // not known

 public:
  PressureInput pressure_input;
  TrackerInput tracker_input;
  InputStatus wrench_status{"tip_force_torque"};

 private:
  void keep(const std::optional<Parsed<Pressures>>& read) {
    if (read) pressures[read->stamp.toSec()] = read->value;
    else if (!pressure_input.status().error().empty() && !pressures.empty())
      pressures[std::max(ros::Time::now().toSec(), pressures.rbegin()->first)] = Pressures();
  }
  void keep(const std::optional<Parsed<Pose>>& read) {
    constexpr double kLeast = 1e-9;  // s; two messages may arrive at one time
    if (read)
      poses[read->stamp.toSec()] = {
          read->value, tracker_input.isRepeated() ? std::max(kLeast, tracker_input.unchangedFor()) : 0.0};
  }
};

// The newest value at a time that is not older than this; nullptr if there is none.
template <class Value>
const Value* newest(const std::map<double, Value>& track, double time, double oldest) {
  auto after = track.upper_bound(time);
  if (after == track.begin() || time - std::prev(after)->first > oldest) return nullptr;
  return &std::prev(after)->second;
}


}  // namespace

bool isBag(const std::string& path) {
  char head[7] = {};
  std::ifstream(path, std::ios::binary).read(head, sizeof head);
  return std::string(head, sizeof head) == "#ROSBAG";
}

Recording loadRecordedBags(const std::vector<std::string>& paths, const BagTopics& topics, const InputParameters& parameters,
                           const Scene* scene) {
  constexpr double kHeartbeat = 1.0, kForever = 1e9;  // s
  Tracks tracks(parameters);
  playBags(paths, topics, parameters, kHeartbeat, tracks);
  Recording recording;
  recording.name = oneLine(paths);
  recording.measures = tracks.tracker_input.knownMeasures();
  recording.wrench_frame = tracks.wrench_frame;
  const double wrench_timeout = parameters.tip_wrench_timeout > 0.0 ? parameters.tip_wrench_timeout : kForever;
  long left_out = 0;
  for (const auto& [time, seen] : tracks.poses) {
    const Pressures* pressures = newest(tracks.pressures, time, parameters.pressure_timeout);
    if (pressures == nullptr || pressures->size() == 0) {
      ++left_out;
      continue;
    }
    RecordedSample sample;
    sample.line = static_cast<int>(recording.samples.size()) + 1;
    sample.time = time - tracks.poses.begin()->first;
    sample.pressures = *pressures;
    sample.tip_position = seen.X_AS.p;
    sample.tip_orientation = Eigen::Quaterniond(seen.X_AS.R);
    if (!recording.samples.empty() && sample.tip_orientation.dot(recording.samples.back().tip_orientation) < 0.0)
      sample.tip_orientation.coeffs() = -sample.tip_orientation.coeffs();
    sample.unchanged_for = seen.unchanged_for;
    if (const Wrench* wrench = newest(tracks.wrenches, time, wrench_timeout)) sample.tip_wrench = *wrench;
    recording.samples.push_back(std::move(sample));
  }
  std::vector<std::string>& warnings = recording.warnings;
  for (const auto& lines :
       {tracks.pressure_input.status().report(), tracks.tracker_input.report(), tracks.wrench_status.report()})
    warnings.insert(warnings.end(), lines.begin(), lines.end());
  for (const auto& [what, count] : tracks.foreign)
    warnings.push_back(std::to_string(count) + " messages on " + what + ": not read");
  if (!tracks.pressure_input.firstSilence().empty()) warnings.push_back(tracks.pressure_input.firstSilence());
  if (left_out > 0)
    warnings.push_back(std::to_string(left_out) + " poses left out: no usable pressures in the " +
                       numberText(parameters.pressure_timeout) + " s before them");
  if (recording.samples.empty())
    throw ConfigurationError("bag " + recording.name,
                             {"no pose on " + topics.pose + " with pressures on " + topics.pressures + " before it" +
                              (warnings.empty() ? "; see rosbag info, and --pressures and --pose" : ": " + oneLine(warnings))});
  const std::optional<double> range = scene != nullptr ? std::optional(fullRange(*scene)) : std::nullopt;
  for (const std::string& warning : unitWarnings(recording, kInputRemedies, range)) warnings.push_back(warning);
  return recording;
}

}  // namespace live_stiffness
