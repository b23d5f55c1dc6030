#include "bags/recorded_bag.h"

#include <algorithm>
#include <map>
#include <optional>

#include "estimation/plausibility.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

// Values of the three topics by their stamps.
class Tracks : public BagListener {
 public:
  void onPressures(const Parsed<Pressures>& reading, const ros::Time& recorded) override {
    if (reading.ok() && reading.value.size() == 0) leaveOut("no pressures in the message");
    else keep(reading, reading.value, recorded, pressures);
  }
  void onPose(const Parsed<TrackedPose>& reading, const ros::Time& recorded) override {
    keep(reading, reading.value.pose, recorded, poses);
  }
  void onWrench(const Parsed<geometry_msgs::WrenchStamped>& message, const ros::Time& recorded) override {
    if (!message.ok()) return leaveOut(message.error);
    const FrameNames own{withoutSlash(message.value.header.frame_id), ""};  // a recording keeps the sensor's axes
    const Parsed<Wrench> reading = readWrench(message.value, own, nullptr);
    keep(reading, reading.value, recorded, wrenches);
  }

  std::map<double, Pressures> pressures;
  std::map<double, Pose> poses;
  std::map<double, Wrench> wrenches;
  int unusable = 0;
  std::string fault;  // of the first unusable one

 private:
  void leaveOut(const std::string& why) {
    if (unusable++ == 0) fault = why;
  }
  template <class Value, class Result>
  void keep(const Parsed<Value>& reading, const Result& result, const ros::Time& recorded, std::map<double, Result>& track) {
    if (!reading.ok()) return leaveOut(reading.error);
    track[(reading.stamp.isZero() ? recorded : reading.stamp).toSec()] = result;
  }
};

template <class Value>
std::optional<Value> newest(const std::map<double, Value>& track, double time) {
  auto after = track.upper_bound(time);
  if (after == track.begin()) return std::nullopt;
  return std::prev(after)->second;
}

const Remedies kRemedies{"--position-unit mm", "--pressure-unit", "--pressure-reference gauge", "--pressure-reference absolute",
                         ""};

}  // namespace

Recording loadRecordedBag(const std::string& path, const BagFormat& format) {
  Tracks tracks;
  readBag(path, format, tracks);
  Recording recording;
  recording.name = path;
  int early = 0;
  for (const auto& [time, pose] : tracks.poses) {
    const std::optional<Pressures> pressures = newest(tracks.pressures, time);
    if (!pressures || (!recording.samples.empty() && pressures->size() != recording.samples.front().pressures.size())) {
      ++early;
      continue;
    }
    RecordedSample sample;
    sample.line = static_cast<int>(recording.samples.size()) + 1;
    sample.time = time - tracks.poses.begin()->first;
    sample.pressures = *pressures;
    sample.tip_position = pose.p;
    sample.tip_orientation = Eigen::Quaterniond(pose.R);
    if (!recording.samples.empty() && sample.tip_orientation.dot(recording.samples.back().tip_orientation) < 0.0)
      sample.tip_orientation.coeffs() = -sample.tip_orientation.coeffs();
    sample.tip_wrench = newest(tracks.wrenches, time);
    recording.samples.push_back(std::move(sample));
  }
  if (tracks.unusable > 0)
    recording.warnings.push_back(std::to_string(tracks.unusable) + " messages left out, the first because: " +
                                 tracks.fault);
  if (early > 0)
    recording.warnings.push_back(std::to_string(early) + " poses left out: no pressures before them, or of another "
                                 "number");
  if (recording.samples.empty())
    throw ConfigurationError(
        "bag " + path, {"no pose on " + format.pose_topic + " with pressures on " + format.pressure_topic + " before it" +
                        (tracks.unusable > 0 ? ": " + tracks.fault : "; see rosbag info, and --pressures and --pose")});
  for (const std::string& warning : unitWarnings(recording, kRemedies)) recording.warnings.push_back(warning);
  return recording;
}

}  // namespace live_stiffness
