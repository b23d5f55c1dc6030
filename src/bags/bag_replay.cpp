#include "bags/bag_replay.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <locale>
#include <sstream>

#include "bags/output_bag.h"
#include "ros/tip_comparison.h"

namespace live_stiffness {
namespace {

TopicReport reportOf(const std::string& name, const InputStatus& status, const ros::Time& begin) {
  TopicReport report{
      name, status.accepted(), status.rejected(), status.outOfOrder(), status.meanRate(), status.longestGap(), 0.0};
  if (report.longest_gap > 0.0) report.gap_start = secondsBetween(begin, status.gapStart());
  return report;
}

// The node without its topics.
class Replay : public BagListener, private EstimateOutput {
 public:
  Replay(const std::string& out, const NodeParameters& parameters)
      : parameters_(parameters), bag_(out), updater_(parameters, *this), comparison_(parameters, *this) {}

  void onPressures(const topic_tools::ShapeShifter& message) override { updater_.onPressures(message, ""); }
  void onChannelPressure(const sensor_msgs::FluidPressure& message, size_t channel) override {
    updater_.onChannelPressure(message, channel);
  }
  void onPose(const topic_tools::ShapeShifter& message) override { compare(comparison_.tracker().read(message)); }
  void onTf(const tf2_msgs::TFMessage& transforms, bool is_static) override {
    compare(comparison_.tracker().read(transforms, is_static));
  }
  void onWrench(const geometry_msgs::WrenchStamped& message) override { updater_.onTipWrench(message); }
  void onHeartbeat() override {
    updater_.onHeartbeat();
    comparison_.tracker().status().checkClock();
  }
  void onForeign(const std::string& topic, const std::string& type) override { ++foreign_[topic + " of type " + type]; }

  // Call at the end: closes the bag and gives it its name.
  void finish() { bag_.finish(); }

  ReplayReport report(const BagSpan& span, const BagTopics& topics) {
    report_.duration = span.duration();
    const InputStatus &pressures = updater_.pressures().status(), &wrenches = updater_.wrenches().status();
    report_.pressures = reportOf(topics.pressures, pressures, span.begin);
    report_.poses = reportOf(topics.pose, comparison_.tracker().status(), span.begin);
    report_.wrenches = reportOf(topics.wrench, wrenches, span.begin);
    std::vector<std::string>& warnings = report_.warnings;
    for (const auto& lines : {pressures.report(), comparison_.tracker().report(), wrenches.report()})
      warnings.insert(warnings.end(), lines.begin(), lines.end());
    for (const auto& [what, count] : foreign_)
      warnings.push_back(std::to_string(count) + " messages on " + what + ": not read");
    for (const std::string& text : {updater_.pressures().firstDoubt(), updater_.pressures().firstSilence()})
      if (!text.empty()) warnings.push_back(text);
    if (!parameters_.is_registered)
      warnings.push_back("not registered: no tracking error and no contact; register_recording makes a file for --registration");
    report_.failures = updater_.failures();
    report_.first_failure = updater_.firstFailure();
    report_.updates = static_cast<long>(times_.size());
    report_.update_median = quantile(times_, 0.5);
    report_.update_p99 = quantile(times_, 0.99);
    report_.numerical_error_median = quantile(numerical_errors_, 0.5);
    report_.numerical_error_max = quantile(numerical_errors_, 1.0);
    report_.tracking_error = summarizeErrors(tracking_errors_);
    return report_;
  }

 private:
  void compare(const std::optional<Parsed<Pose>>& X_AS) {
    if (X_AS) comparison_.compare(*X_AS, updater_.stateAt(X_AS->stamp, parameters_.registration.tracker_delay));
  }
  template <class Message>
  void write(const char* topic, const Message& message) {
    bag_.write(std::string("/stiffness_node/") + topic, ros::Time::now(), message);
  }
  void onEstimate(const StiffnessEstimate::ConstPtr& estimate, const Pose* X_BT) override {
    write("estimate", *estimate);
    ++report_.estimates;
    report_.stale_estimates += estimate->stale;
    if (X_BT == nullptr) return;
    times_.push_back(estimate->solve_time);
    numerical_errors_.push_back(estimate->numerical_error);
    write("tip_pose", toPoseStamped(*X_BT, estimate->header.stamp, parameters_.frames.base));
  }
  void onTrackingError(const TrackingError& error) override {
    tracking_errors_.push_back(error.distance);
    write("tracking_error", error);
  }
  void onContact(const TipContact& contact, const geometry_msgs::WrenchStamped& wrench) override {
    ++report_.contacts;
    report_.in_contact += contact.contact;
    write("tip_wrench_estimate", wrench);
    write("tip_contact", contact);
  }

  const NodeParameters& parameters_;
  OutputBag bag_;
  EstimateUpdater updater_;
  TipComparison comparison_;
  std::map<std::string, long> foreign_;
  ReplayReport report_;
  std::vector<double> times_, numerical_errors_, tracking_errors_;
};

}  // namespace

ReplayReport replayBags(const std::vector<std::string>& bags, const std::string& out, const NodeParameters& parameters,
                        const BagTopics& topics, const std::function<void(long, long)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  for (const std::string& bag : bags) {
    std::error_code ignored;
    if (bag == out || std::filesystem::equivalent(bag, out, ignored))
      throw ConfigurationError("bag " + out, {"is the one to be read: give another to be written"});
  }
  Replay replay(out, parameters);
  const BagSpan span = playBags(bags, topics, parameters, 1.0 / parameters.heartbeat, replay, progress);
  ReplayReport report = replay.report(span, topics);
  if (report.pressures.accepted == 0)
    throw ConfigurationError("bag " + oneLine(bags), {"no usable pressures on " + topics.pressures +
                                                      (report.warnings.empty() ? "; see rosbag info, and --pressures"
                                                                               : ": " + oneLine(report.warnings))});
  replay.finish();
  report.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::string ReplayReport::text(const std::string& bag, const NodeParameters& parameters) const {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(3);
  out << "# " << bag << "\n\n"
      << duration << " s of bag in " << wall_time << " s, " << duration / wall_time << " times real time.\n\n"
      << "| topic | accepted | rejected | out of order | rate, Hz | longest gap, s, at s |\n"
      << "|---|---|---|---|---|---|\n";
  for (const TopicReport* topic : {&pressures, &poses, &wrenches})
    out << "| " << topic->name << " | " << topic->accepted << " | " << topic->rejected << " | " << topic->out_of_order
        << " | " << numberText(topic->rate) << " | " << numberText(topic->longest_gap) << " at "
        << numberText(topic->gap_start) << " |\n";
  for (const std::string& warning : warnings) out << "\n- " << warning;
  out << "\n\nEstimates: " << estimates << ", stale: " << stale_estimates << "; updates: " << updates
      << ", failed: " << failures << (failures > 0 ? " (" + first_failure + ")" : "")
      << "\n\nSpeed against error: median " << 1e6 * update_median << " us, p99 " << 1e6 * update_p99
      << " us an update, at an estimated relative error of " << numerical_error_median << " in the median and "
      << numerical_error_max << " at most (accuracy asked for: " << parameters.model.accuracy << ").\n\nTracking error: "
      << (tracking_error.count > 0 ? millimetreText(tracking_error) : "no poses to compare with");
  if (contacts > 0) out << "\n\nContact: " << in_contact << " of " << contacts << " samples";
  out << "\n";
  return out.str();
}

}  // namespace live_stiffness
