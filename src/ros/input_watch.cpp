#include "live_stiffness/ros/input_watch.h"

#include <ros/console.h>

#include <cmath>

namespace live_stiffness {
namespace {

// True, and the clock restarted, if `last` is at least `seconds` ago. Not ROS_ERROR_THROTTLE and its kin: they share
// one clock between all inputs, and stop when simulated time does.
bool isDue(ros::WallTime& last, double seconds) {
  const ros::WallTime now = ros::WallTime::now();
  if (now - last < ros::WallDuration(seconds)) return false;
  last = now;
  return true;
}

}  // namespace

void InputWatch::accept(const ros::Time& now) {
  const double interval = accepted_ > 0 ? (now - last_accepted_).toSec() : 0.0;
  if (interval > 0.0) {
    const double blend = rate_ > 0.0 ? 0.1 : 1.0;
    const double smoothed_interval = (1.0 - blend) * (rate_ > 0.0 ? 1.0 / rate_ : 0.0) + blend * interval;
    rate_ = 1.0 / smoothed_interval;
  }
  last_accepted_ = now;
  ++accepted_;
  current_fault_.clear();
}

void InputWatch::reject(const std::string& fault) {
  ++rejected_;
  current_fault_ = fault;
  if (isDue(fault_logged_, 1.0)) ROS_ERROR_STREAM(name_ << ": " << fault);
}

ros::Time InputWatch::stampFor(const ros::Time& stamp, const ros::Time& now) {
  constexpr double kForeign = 10.0;  // s
  if (stamp.isZero()) return now;
  if (now.isZero()) return stamp;  // simulated time has not begun: the first message overtook /clock
  if (std::abs((stamp - now).toSec()) <= kForeign) return stamp;
  ++foreign_stamps_;
  if (isDue(stamp_logged_, 60.0))
    ROS_WARN_STREAM(name_ << ": stamps are " << (stamp - now).toSec()
                          << " s from ROS time (a device's own clock?); using the time of arrival");
  return now;
}

void InputWatch::number(const std::string& publisher, uint32_t sequence) {
  constexpr uint32_t kRenumbered = 100000;  // more at once is no loss
  const uint32_t step = sequence - sequence_;
  if (publisher == publisher_ && sequence > sequence_ && step < kRenumbered) lost_ += step - 1;
  publisher_ = publisher;
  sequence_ = sequence;
}

double InputWatch::age(const ros::Time& now) const {
  return accepted_ > 0 ? (now - last_accepted_).toSec() : 1e9;
}

void InputWatch::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("rate (Hz)", rate_);
  status.add("accepted", accepted_);
  status.add("rejected", rejected_);
  status.add("lost", lost_);
}

void InputWatch::restart() {
  last_accepted_ = ros::Time();
  accepted_ = 0;
  rate_ = 0.0;
  current_fault_.clear();
}

}  // namespace live_stiffness
