#include "bags/bag_replay.h"

#include <chrono>
#include <filesystem>
#include <locale>
#include <optional>
#include <sstream>

#include "estimation/motion_history.h"
#include "bags/bag_reader.h"
#include "bags/output_bag.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {
namespace {

// Counts the messages of a topic.
class TopicWatch {
 public:
  explicit TopicWatch(const std::string& name) { report_.name = name; }

  // True if the reading can be used.
  template <class Value>
  bool accept(const Parsed<Value>& reading, const ros::Time& stamp) {
    if (!reading.ok()) return reject(reading.error);
    if (report_.usable++ > 0) {
      const double interval = secondsBetween(last_, stamp);
      report_.backward += interval < 0.0;
      intervals_.push_back(interval);
      if (interval > report_.longest_gap) report_.longest_gap = interval, gap_start_ = last_;
    }
    last_ = stamp;
    return true;
  }
  bool reject(const std::string& fault) {
    if (report_.unusable++ == 0) report_.first_fault = fault;
    return false;
  }
  TopicReport report(const ros::Time& begin) {
    const double interval = quantile(intervals_, 0.5);
    if (interval > 0.0) report_.rate = 1.0 / interval;
    if (report_.longest_gap > 0.0) report_.gap_start = secondsBetween(begin, gap_start_);
    return report_;
  }

 private:
  TopicReport report_;
  ros::Time last_, gap_start_;
  std::vector<double> intervals_;
};

class Replay : public BagListener {
 public:
  Replay(const std::string& out, const Scene& scene, const ModelOptions& model, const ReplayOptions& options)
      : options_(options),
        estimator_(scene, model, options.estimator),
        bag_(out),
        pressures_(options.format.pressure_topic),
        poses_(options.format.pose_topic),
        wrenches_(options.format.wrench_topic) {
    const std::vector<int>& channels = options.channel_of_chamber;
    if (!channels.empty() && channels.size() != static_cast<size_t>(scene.chamberCount()))
      throw ConfigurationError("channel_of_chamber",
                               {std::to_string(channels.size()) + " entries: must be one for each of the scene's " +
                                std::to_string(scene.chamberCount()) + " chambers"});
    if (!channels.empty()) channel_map_ = ChannelMap(channels);
  }

  void onPressures(const Parsed<Pressures>& reading, const ros::Time& recorded) override {
    recorded_ = recorded;
    is_stale_ = true;
    const int channels = static_cast<int>(reading.value.size());
    const ChannelMap* map = reading.ok() ? channelMap(channels) : nullptr;
    if (reading.ok() && map == nullptr) {
      pressures_.reject(channelFault(channels));
      return;
    }
    const ros::Time stamp = stampOf(reading.stamp);
    if (!pressures_.accept(reading, stamp)) return;
    is_stale_ = false;
    pressure_stamp_ = stamp;
    StiffnessEstimator::Outcome outcome = estimator_.setPressures(map->expand(reading.value), stamp.toSec());
    const bool is_due = secondsBetween(estimate_stamp_, stamp) >= 1.0 / options_.heartbeat || stamp < estimate_stamp_;
    if (outcome == StiffnessEstimator::Outcome::kUnchanged && is_due) outcome = estimator_.solve();
    onSolved(outcome);
    if (estimator_.estimate() != nullptr && !is_stale_)
      history_.add({stamp.toSec(), estimator_.pressures(), estimator_.estimate()->solution.X_BT});
  }

  void onPose(const Parsed<TrackedPose>& reading, const ros::Time& recorded) override {
    recorded_ = recorded;
    const ros::Time stamp = stampOf(reading.stamp);
    if (!poses_.accept(reading, stamp) || is_stale_ || estimator_.estimate() == nullptr || history_.empty()) return;
    const Pose measured = options_.registration.tipPose(reading.value.pose);
    const double delay = options_.registration.tracker_delay;
    const Pose predicted =
        delay == 0.0 ? estimator_.estimate()->solution.X_BT : history_.at(stamp.toSec() - delay).X_BT;
    const Twist residual = residualTwist(measured, predicted);
    tracking_errors_.push_back(linear(residual).norm());
    bag_.write("/stiffness_node/tracking_error", recorded_,
               toTrackingError(measured, predicted, residual, stamp, options_.frames.base));
  }

  void onWrench(const Parsed<geometry_msgs::WrenchStamped>& message, const ros::Time& recorded) override {
    recorded_ = recorded;
    if (!message.ok()) {
      wrenches_.reject(message.error);
      return;
    }
    const Pose* X_BT = estimator_.estimate() ? &estimator_.estimate()->solution.X_BT : nullptr;
    const Parsed<Wrench> reading = readWrench(message.value, options_.frames, X_BT);
    if (!wrenches_.accept(reading, stampOf(reading.stamp))) return;
    if (!is_stale_) onSolved(estimator_.setTipWrench(reading.value));
  }

  // Call at the end: closes the bag and gives it its name.
  void finish() { bag_.finish(); }

  // begin: of the bag.
  ReplayReport report(const ros::Time& begin) {
    report_.pressures = pressures_.report(begin);
    report_.poses = poses_.report(begin);
    report_.wrenches = wrenches_.report(begin);
    report_.updates = static_cast<long>(times_.size());
    report_.update_median = quantile(times_, 0.5);
    report_.update_p99 = quantile(times_, 0.99);
    report_.numerical_error_median = quantile(numerical_errors_, 0.5);
    report_.numerical_error_max = quantile(numerical_errors_, 1.0);
    report_.tracking_error = summarizeErrors(tracking_errors_);
    return report_;
  }

 private:
  // The map of a message of `channels` channels; nullptr when they cannot feed the scene's chambers.
  const ChannelMap* channelMap(int channels) {
    const int chambers = estimator_.model().scene().chamberCount();
    if (!channel_map_ && channels > 0 && chambers % channels == 0) channel_map_ = ChannelMap::even(channels, chambers);
    return channel_map_ && channel_map_->channelCount() == channels ? &*channel_map_ : nullptr;
  }
  std::string channelFault(int channels) const {
    const int chambers = estimator_.model().scene().chamberCount();
    return std::to_string(channels) + " channels: must be " +
           (channel_map_ ? std::to_string(channel_map_->channelCount())
                         : "a divisor of the scene's " + std::to_string(chambers) + " chambers") +
           "; see --scene and --channel-of-chamber";
  }
  ros::Time stampOf(const ros::Time& stamp) const { return stamp.isZero() ? recorded_ : stamp; }

  void onSolved(StiffnessEstimator::Outcome outcome) {
    if (outcome == StiffnessEstimator::Outcome::kUnchanged) return;
    if (outcome == StiffnessEstimator::Outcome::kFailed) {
      is_stale_ = true;
      if (report_.failures++ == 0) report_.first_failure = estimator_.statusText();
    } else {
      estimate_stamp_ = pressure_stamp_;
      times_.push_back(estimator_.estimate()->solve_time);
      numerical_errors_.push_back(estimator_.estimate()->solution.numerical_error);
    }
    if (estimator_.estimate() == nullptr) return;
    StiffnessEstimate message = toEstimate(*estimator_.estimate(), estimate_stamp_, options_.frames.base);
    setStatus(estimator_.status().code, estimator_.statusText(), false, 0.0, "pressures", message);
    bag_.write("/stiffness_node/estimate", recorded_, message);
    if (!message.stale)
      bag_.write("/stiffness_node/tip_pose", recorded_,
                 toPoseStamped(estimator_.estimate()->solution.X_BT, estimate_stamp_, options_.frames.base));
  }

  const ReplayOptions& options_;
  std::optional<ChannelMap> channel_map_;
  StiffnessEstimator estimator_;
  MotionHistory history_;
  OutputBag bag_;
  TopicWatch pressures_, poses_, wrenches_;
  ros::Time recorded_, pressure_stamp_, estimate_stamp_;
  bool is_stale_ = true;  // the estimate is not that of the newest pressures
  ReplayReport report_;
  std::vector<double> times_, numerical_errors_, tracking_errors_;
};

}  // namespace

ReplayReport replayBag(const std::string& bag, const std::string& out, const Scene& scene, const ModelOptions& model,
                       const ReplayOptions& options, const std::function<void(long, long)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  std::error_code ignored;
  if (bag == out || std::filesystem::equivalent(bag, out, ignored))
    throw ConfigurationError("bag " + out, {"is the one to be read: give another to be written"});
  Replay replay(out, scene, model, options);
  const BagSpan span = readBag(bag, options.format, replay, progress);
  ReplayReport report = replay.report(span.begin);
  report.duration = secondsBetween(span.begin, span.end);
  if (report.pressures.usable == 0)
    throw ConfigurationError("bag " + bag, {"no usable pressures on " + options.format.pressure_topic +
                                            (report.pressures.unusable > 0 ? ": " + report.pressures.first_fault
                                                                           : "; see rosbag info, and --pressures")});
  replay.finish();
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::string ReplayReport::text(const std::string& bag, double accuracy) const {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(3);
  out << "# " << bag << "\n\n"
      << duration << " s of bag in " << wall_time << " s, " << duration / wall_time << " times real time.\n\n"
      << "| topic | usable | unusable | rate, Hz | longest gap, s, at s | stamps going back |\n"
      << "|---|---|---|---|---|---|\n";
  for (const TopicReport* topic : {&pressures, &poses, &wrenches})
    out << "| " << topic->name << " | " << topic->usable << " | " << topic->unusable << " | " << numberText(topic->rate)
        << " | " << numberText(topic->longest_gap) << " at " << numberText(topic->gap_start) << " | " << topic->backward
        << " |\n";
  for (const TopicReport* topic : {&pressures, &poses, &wrenches})
    if (topic->unusable > 0) out << "\nFirst unusable on " << topic->name << ": " << topic->first_fault << "\n";
  out << "\nUpdates: " << updates << ", failed: " << failures << (failures > 0 ? " (" + first_failure + ")" : "")
      << "\n\nSpeed against error: median " << 1e6 * update_median << " us, p99 " << 1e6 * update_p99
      << " us an update, at an estimated relative error of " << numerical_error_median << " in the median and "
      << numerical_error_max << " at most (accuracy asked for: " << accuracy << ").\n\nTracking error: "
      << (tracking_error.count > 0 ? millimetreText(tracking_error) : "no poses to compare with") << "\n";
  return out.str();
}

}  // namespace live_stiffness
