#include "ros/input_watch.h"

#include <ros/console.h>

#include <cmath>

namespace live_stiffness {
namespace {

constexpr double kForeign = 10.0;     // s behind ROS time; a device's own clock
constexpr double kFuture = 0.5;       // s ahead of ROS time
constexpr double kReordered = 1.0;    // s
constexpr double kJump = 0.5;         // s back; less is a wall clock being corrected

// True, and the clock restarted, if `last` is at least `seconds` ago. Not ROS_ERROR_THROTTLE and its kin: they share
// one clock between all inputs, and stop when simulated time does.
bool isDue(ros::WallTime& last, double seconds) {
  const ros::WallTime now = ros::WallTime::now();
  if (now - last < ros::WallDuration(seconds)) return false;
  last = now;
  return true;
}

}  // namespace

void InputWatch::accept(const ros::Time& now, const ros::Time& stamp) {
  notice(now);
  const double interval = accepted_ > 0 ? (now - last_accepted_).toSec() : 0.0;
  if (interval > 0.0) {
    const double blend = rate_ > 0.0 ? 0.1 : 1.0;
    const double smoothed_interval = (1.0 - blend) * (rate_ > 0.0 ? 1.0 / rate_ : 0.0) + blend * interval;
    rate_ = 1.0 / smoothed_interval;
  }
  last_accepted_ = now;
  last_stamp_ = stamp;
  ++accepted_;
  current_fault_.clear();
}

void InputWatch::reject(const std::string& fault) {
  ++rejected_;
  current_fault_ = fault;
  if (isDue(fault_logged_, 1.0)) ROS_ERROR_STREAM(name_ << ": " << fault);
}

ros::Time InputWatch::stampFor(const ros::Time& stamp, const ros::Time& now) {
  foreign_offset_ = 0.0;
  if (stamp.isZero()) return now;
  if (now.isZero()) return stamp;  // simulated time has not begun: the first message overtook /clock
  const double offset = (stamp - now).toSec();
  if (offset >= -kForeign && offset <= kFuture) return stamp;
  foreign_offset_ = offset;
  ++foreign_stamps_;
  if (isDue(stamp_logged_, 60.0))
    ROS_WARN_STREAM(name_ << ": stamps are " << offset
                          << " s from ROS time (a device's own clock?); using the time of arrival");
  return now;
}

bool InputWatch::mayRetry() {
  const auto now = std::chrono::steady_clock::now();
  if (now - retried_ < std::chrono::seconds(1)) return false;
  retried_ = now;
  return true;
}

void InputWatch::number(const std::string& publisher, uint32_t sequence) {
  constexpr uint32_t kRenumbered = 100000;  // more at once is no loss
  const uint32_t step = sequence - sequence_;
  if (publisher == publisher_ && sequence > sequence_ && step < kRenumbered) lost_ += step - 1;
  publisher_ = publisher;
  sequence_ = sequence;
}

bool InputWatch::arrivesInOrder(const ros::Time& stamp) {
  const double step = last_raw_stamp_.isZero() || stamp.isZero() ? 0.0 : (stamp - last_raw_stamp_).toSec();
  if (step < 0.0 && step >= -kReordered) {
    ++out_of_order_;
    overtaken_ = ros::WallTime::now();
    return false;
  }
  last_raw_stamp_ = stamp;
  return true;
}

void InputWatch::notice(const ros::Time& now) {
  if (accepted_ > 0 && (now - last_accepted_).toSec() < -kJump) restart();
}

double InputWatch::age(const ros::Time& now) const {
  constexpr double kNever = 1e9;
  if (accepted_ == 0 || (now - last_accepted_).toSec() < -kJump) return kNever;
  return (now - last_stamp_).toSec();
}

std::string InputWatch::oddity() const {
  if (foreign_offset_ != 0.0)
    return "stamps are not in ROS time, but " + std::to_string(std::abs(foreign_offset_)) + " s " +
           (foreign_offset_ > 0.0 ? "ahead" : "behind") + "; the time of arrival is used";
  if (ros::WallTime::now() - overtaken_ < ros::WallDuration(2.0))
    return "messages arrive out of order: " + std::to_string(out_of_order_) + " left out so far";
  return "";
}

void InputWatch::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("rate (Hz)", rate_);
  status.add("accepted", accepted_);
  status.add("rejected", rejected_);
  status.add("lost", lost_);
  status.add("out of order", out_of_order_);
}

void InputWatch::restart() {
  last_accepted_ = last_stamp_ = last_raw_stamp_ = ros::Time();
  accepted_ = 0;
  rate_ = 0.0;
  current_fault_.clear();
}

}  // namespace live_stiffness
