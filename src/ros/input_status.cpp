#include "ros/input_status.h"

#include <ros/console.h>

#include <cmath>
#include <utility>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kForeign = 10.0;   // s behind ROS time; a device's own clock
constexpr double kFuture = 0.5;     // s ahead of ROS time
constexpr double kReordered = 1.0;  // s
constexpr double kJump = 0.5;       // s back; smaller jumps are corrections of the wall clock

// True if `last` is at least `seconds` ago; then sets it to now. ROS_ERROR_THROTTLE would share one clock between all inputs,
// and would be silent while simulated time stands still.
bool isDue(ros::WallTime& last, double seconds) {
  const ros::WallTime now = ros::WallTime::now();
  if (now - last < ros::WallDuration(seconds)) return false;
  last = now;
  return true;
}

}  // namespace

std::optional<ros::Time> InputStatus::accept(const ros::Time& stamp, const ros::Time& now) {
  checkClock(now);
  if (!arrivesInOrder(stamp)) return std::nullopt;
  const double interval = has_message_ ? secondsBetween(last_accepted_, now) : 0.0;
  if (interval > longest_gap_) longest_gap_ = interval, gap_start_ = last_accepted_;
  if (interval > 0.0) {
    const double blend = rate_ > 0.0 ? 0.1 : 1.0;
    rate_ = 1.0 / ((1.0 - blend) * (rate_ > 0.0 ? 1.0 / rate_ : 0.0) + blend * interval);
  }
  if (accepted_ == 0) first_accepted_ = now;
  last_accepted_ = now;
  last_stamp_ = stampFor(stamp, now);
  ++accepted_;
  has_message_ = true;
  error_.clear();
  return last_stamp_;
}

void InputStatus::reject(const std::string& error) {
  error_ = error;
  logError(error);
}

void InputStatus::logError(const std::string& error) {
  if (rejected_++ == 0) first_error_ = error;
  if (isDue(error_logged_, 1.0)) ROS_ERROR_STREAM(name_ << ": " << error);
}

ros::Time InputStatus::stampFor(const ros::Time& stamp, const ros::Time& now) {
  foreign_offset_ = 0.0;
  if (stamp.isZero()) return now;
  if (now.isZero()) return stamp;  // simulated time has not begun: the first message overtook /clock
  const double offset = secondsBetween(now, stamp);
  if (offset >= -kForeign && offset <= kFuture) return stamp;
  foreign_offset_ = offset;
  if (foreign_++ == 0) first_foreign_offset_ = offset;
  if (isDue(stamp_logged_, 60.0))
    ROS_WARN_STREAM(name_ << ": stamps are " << offset
                          << " s from ROS time (a device's own clock?); using the time of arrival");
  return now;
}

void InputStatus::countLost(const std::string& publisher, uint32_t sequence) {
  constexpr uint32_t kRenumbered = 100000;  // a larger step is a new count, not a loss
  const uint32_t step = sequence - sequence_;
  if (publisher == publisher_ && sequence > sequence_ && step < kRenumbered) lost_ += step - 1;
  publisher_ = publisher;
  sequence_ = sequence;
}

bool InputStatus::arrivesInOrder(const ros::Time& stamp) {
  const double step = last_own_stamp_.isZero() || stamp.isZero() ? 0.0 : secondsBetween(last_own_stamp_, stamp);
  if (step < 0.0 && step >= -kReordered) {
    ++out_of_order_;
    overtaken_ = ros::WallTime::now();
    return false;
  }
  last_own_stamp_ = stamp;
  return true;
}

void InputStatus::checkClock(const ros::Time& now) {
  if (has_message_ && secondsBetween(last_accepted_, now) < -kJump) restart();
}

double InputStatus::age(const ros::Time& now) const {
  constexpr double kNever = 1e9;
  if (!has_message_ || secondsBetween(last_accepted_, now) < -kJump) return kNever;
  return secondsBetween(last_stamp_, now);
}

std::string InputStatus::warning() const {
  if (foreign_offset_ != 0.0)
    return "stamps are not in ROS time, but " + std::to_string(std::abs(foreign_offset_)) + " s " +
           (foreign_offset_ > 0.0 ? "ahead" : "behind") + "; the time of arrival is used";
  if (ros::WallTime::now() - overtaken_ < ros::WallDuration(2.0))
    return "messages arrive out of order: " + std::to_string(out_of_order_) + " left out so far";
  return "";
}

double InputStatus::meanRate() const {
  const double time = secondsBetween(first_accepted_, last_accepted_) - longest_gap_;
  return accepted_ > 2 && time > 0.0 ? static_cast<double>(accepted_ - 2) / time : 0.0;
}

std::vector<std::string> InputStatus::report() const {
  std::vector<std::string> lines;
  const auto add = [&](long count, const std::string& what) {
    if (count > 0) lines.push_back(name_ + ": " + std::to_string(count) + " " + what);
  };
  add(rejected_, "cannot be used, the first because: " + first_error_);
  add(foreign_, "stamps are not in ROS time, the first " + numberText(std::abs(first_foreign_offset_)) + " s " +
                    (first_foreign_offset_ > 0.0 ? "ahead" : "behind") + ": the time of arrival is used");
  add(out_of_order_, "out of order, overtaken by newer ones: left out");
  return lines;
}

long InputStatus::newlyLost() { return lost_ - std::exchange(lost_before_, lost_); }

void InputStatus::addCounts(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("rate (Hz)", rate_);
  status.add("accepted", accepted_);
  status.add("rejected", rejected_);
  status.add("lost", lost_);
  status.add("out of order", out_of_order_);
}

void InputStatus::restart() {
  last_accepted_ = last_stamp_ = last_own_stamp_ = ros::Time();
  has_message_ = false;
  rate_ = 0.0;
  error_.clear();
}

bool ArrayStatus::accept(Parsed<Eigen::VectorXd>& parsed, const std::string& publisher) {
  if (parsed.sequence) countLost(publisher, *parsed.sequence);
  const int count = static_cast<int>(parsed.value.size());
  if (parsed.ok() && count == 0 && settings_.count == 0) parsed.error = "no " + settings_.noun + " in the message";
  else if (parsed.ok() && settings_.count > 0 && (settings_.spare ? count < settings_.count : count != settings_.count))
    parsed.error = std::to_string(count) + " " + settings_.counted + ": must be " + (settings_.spare ? "at least " : "") +
                   std::to_string(settings_.count) + settings_.hint;
  if (!parsed.ok()) {
    reject(parsed.error);
    return false;
  }
  if (settings_.count == 0) settings_.count = count;
  const std::optional<ros::Time> stamp = InputStatus::accept(parsed.stamp);
  parsed.stamp = stamp.value_or(ros::Time());
  return stamp.has_value();
}

void ArrayStatus::diagnose(const std::string& solver_error, const std::string& missing, const std::string& doubt,
                           diagnostic_updater::DiagnosticStatusWrapper& status) {
  const long lost = newlyLost();
  if (!error().empty() || !solver_error.empty())
    status.summary(DiagnosticStatus::ERROR, error().empty() ? solver_error : error());
  else if (!hasMessage())
    status.summary(DiagnosticStatus::ERROR, "no " + settings_.noun + " received yet" + missing);
  else if (isStale())
    status.summaryf(DiagnosticStatus::ERROR, "%s are stale: %.1f s old%s", settings_.noun.c_str(), age(), missing.c_str());
  else if (!warning().empty())
    status.summary(DiagnosticStatus::WARN, warning());
  else if (!doubt.empty())
    status.summary(DiagnosticStatus::WARN, doubt);
  else if (lost > 0)
    status.summaryf(DiagnosticStatus::WARN, "%ld messages lost since the last report: they come faster than they are processed",
                    lost);
  else
    status.summary(DiagnosticStatus::OK, "ok");
  addCounts(status);
}

}  // namespace live_stiffness
