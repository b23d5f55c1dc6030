#pragma once
// Status of one input topic: how old its newest good message is, how fast good ones come, and what was wrong with the
// last bad one.

#include <ros/time.h>

#include <Eigen/Core>
#include <optional>
#include <string>

#include "ros/parsed.h"

namespace diagnostic_updater {
class DiagnosticStatusWrapper;
}

namespace live_stiffness {

class InputStatus {
 public:
  // name: for log lines, such as "chamber_pressures".
  explicit InputStatus(std::string name) : name_(std::move(name)) {}

  // A message that can be read arrives, stamped `stamp` (zero: it has none). Returns the stamp to use for it, and forgets
  // the last error: its own stamp, or the time of arrival if it has none or another clock wrote it (more than ten seconds
  // behind ROS time, or half a second ahead of it). None if the message must be left out, because the one before was
  // newer by at most a second; a stamp older than that is of a clock that was set, as when a driver or a bag restarts.
  std::optional<ros::Time> accept(const ros::Time& stamp) { return accept(stamp, ros::Time::now()); }
  std::optional<ros::Time> accept(const ros::Time& stamp, const ros::Time& now);
  // A message cannot be used: error() is the reason until the next good one.
  void reject(const std::string& error);
  // Counts an error, and logs it at most once a second.
  void logError(const std::string& error);
  // Counts the messages that were lost before this one, in the publisher's queue or in ours, by its sequence number.
  void countLost(const std::string& publisher, uint32_t sequence);

  // Seconds since what the last good message tells was true: grows while none comes, and is large at once if they come
  // late. A very large number before the first, and after ROS time jumped back.
  double age() const { return age(ros::Time::now()); }
  double age(const ros::Time& now) const;
  bool hasMessage() const { return accepted_ > 0; }
  // Forgets ages and rates if ROS time jumped back, as when a bag is played in a loop. To be called now and then.
  void checkClock() { checkClock(ros::Time::now()); }
  void checkClock(const ros::Time& now);
  // Forgets ages and rates.
  void restart();

  const std::string& name() const { return name_; }
  // Why the newest message cannot be used; empty: it can.
  const std::string& error() const { return error_; }
  // What is unusual about the newest messages although they can be used; empty: nothing.
  std::string warning() const;
  // Messages lost since the last call.
  long newlyLost();
  // Adds rate and counts to a diagnostics entry.
  void addCounts(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  bool arrivesInOrder(const ros::Time& stamp);
  ros::Time stampFor(const ros::Time& stamp, const ros::Time& now);

  std::string name_, error_;
  ros::Time last_accepted_, last_stamp_;  // when the last good message arrived, and the stamp used for it
  ros::Time last_own_stamp_;              // that the newest message came with
  ros::WallTime error_logged_, stamp_logged_, overtaken_;
  double rate_ = 0.0;            // of good messages, 1/s, smoothed
  double foreign_offset_ = 0.0;  // of the newest stamp from ROS time, s; 0: of the same clock
  long accepted_ = 0, rejected_ = 0, out_of_order_ = 0, lost_ = 0, lost_before_ = 0;
  std::string publisher_;  // of the newest numbered message
  uint32_t sequence_ = 0;  // its number
};

// Status of a topic whose numbers drive a robot, pressures or rod lengths: also whether they are as many as there must be.
class ArrayStatus : public InputStatus {
 public:
  struct Settings {
    std::string topic;
    std::string noun;      // for people: "pressures"
    std::string counted;   // what there must be `count` of: "channels"
    std::string hint;      // added where the count is wrong; may be empty
    int count = 0;
    double timeout = 0.5;  // s, after which they are stale
  };
  explicit ArrayStatus(Settings settings) : InputStatus(settings.topic), settings_(std::move(settings)) {}

  // Whether a message of this publisher can be used; `parsed` then has the stamp to use for it, else error() is why not,
  // or it is left out as out of order.
  bool accept(Parsed<Eigen::VectorXd>& parsed, const std::string& publisher);
  // From now on there must be so many.
  void setCount(int count) { settings_.count = count; }
  bool isStale() const { return age() > settings_.timeout; }
  // solver_error: why nothing can be solved from the newest ones; empty: it can.
  void diagnose(const std::string& solver_error, diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  Settings settings_;
};

}  // namespace live_stiffness
