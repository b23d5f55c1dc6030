#include "ros/recorded_bag.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <map>
#include <optional>

#include "live_stiffness/checks.h"
#include "ros/bag_message.h"
#include "ros/bag_structure.h"

namespace live_stiffness {
namespace {

// Messages of the three topics by their stamps.
struct Tracks {
  std::map<double, Pressures> pressures;
  std::map<double, Pose> poses;
  std::map<double, Wrench> wrenches;
  int unreadable = 0;
  std::string fault;  // of the first one
};

void leaveOut(const std::string& fault, Tracks& tracks) {
  if (tracks.unreadable++ == 0) tracks.fault = fault;
}

template <class Value, class Result>
void keep(const Reading<Value>& reading, const ros::Time& recorded, const Result& result,
          std::map<double, Result>& track, Tracks& tracks) {
  if (reading.ok()) {
    track[(reading.stamp.isZero() ? recorded : reading.stamp).toSec()] = result;
    return;
  }
  leaveOut(reading.fault, tracks);
}

template <class Value>
std::optional<Value> newest(const std::map<double, Value>& track, double time) {
  auto after = track.upper_bound(time);
  if (after == track.begin()) return std::nullopt;
  return std::prev(after)->second;
}

Tracks readTracks(const std::string& path, const BagFormat& format) {
  Tracks tracks;
  checkBagStructure(path);
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    const std::string topic = withoutSlash(message.getTopic());
    std::string fault;
    if (topic == withoutSlash(format.wrench_topic)) {
      const auto wrench = readMessage<geometry_msgs::WrenchStamped>(message, fault);
      if (!wrench) {
        leaveOut(fault, tracks);
        continue;
      }
      const FrameNames own{withoutSlash(wrench->header.frame_id), ""};  // a recording keeps the sensor's axes
      const Reading<Wrench> reading = readWrench(*wrench, own, nullptr);
      keep(reading, message.getTime(), reading.value, tracks.wrenches, tracks);
      continue;
    }
    const bool is_pressure = topic == withoutSlash(format.pressure_topic);
    if (!is_pressure && topic != withoutSlash(format.pose_topic)) continue;
    const auto any = readMessage<topic_tools::ShapeShifter>(message, fault);
    if (!any) {
      leaveOut(fault, tracks);
    } else if (is_pressure) {
      const Reading<Pressures> reading = readPressures(*any, format.pressures);
      if (reading.ok() && reading.value.size() == 0) leaveOut("no pressures in the message", tracks);
      else keep(reading, message.getTime(), reading.value, tracks.pressures, tracks);
    } else {
      const Reading<TrackedPose> reading = readPose(*any, format.position_unit);
      keep(reading, message.getTime(), reading.value.pose, tracks.poses, tracks);
    }
  }
  return tracks;
}

// What numbers that a robot cannot have look like. Faults of units leave a fit that fails far from the reason.
void warnOfUnits(Recording& recording) {
  constexpr double kFarthest = 5.0;       // m, that a tip moves
  constexpr double kLeastPressure = 1e3;  // Pa, of a session in which the robot moves
  double motion = 0.0, pressure = 0.0;
  for (const RecordedSample& sample : recording.samples) {
    motion = std::max(motion, (sample.tip_position - recording.samples.front().tip_position).norm());
    pressure = std::max(pressure, sample.pressures.cwiseAbs().maxCoeff());
  }
  if (motion > kFarthest)
    recording.warnings.push_back("the tip moves by " + numberText(motion) + " m: millimetres? (--position-unit mm)");
  if (pressure > 0.0 && pressure < kLeastPressure)
    recording.warnings.push_back("no pressure is above " + numberText(pressure) + " Pa: another unit? (--pressure-unit)");
}

}  // namespace

Recording loadRecordedBag(const std::string& path, const BagFormat& format) {
  Tracks tracks;
  try {
    tracks = readTracks(path, format);
  } catch (const rosbag::BagException& error) {
    throw ConfigurationError("bag " + path, {std::string("cannot be read: ") + error.what()});
  }
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
  if (tracks.unreadable > 0)
    recording.warnings.push_back(std::to_string(tracks.unreadable) + " messages left out, the first because: " +
                                 tracks.fault);
  if (early > 0)
    recording.warnings.push_back(std::to_string(early) + " poses left out: no pressures before them, or of another "
                                 "number");
  if (recording.samples.empty())
    throw ConfigurationError(
        "bag " + path, {"no pose on " + format.pose_topic + " with pressures on " + format.pressure_topic + " before it" +
                        (tracks.unreadable > 0 ? ": " + tracks.fault : "; see rosbag info, and --pressures and --pose")});
  warnOfUnits(recording);
  return recording;
}

}  // namespace live_stiffness
