#pragma once
// Status of one input topic: how old its newest good message is, how fast good ones come, and what was wrong with the
// last bad one.

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/time.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "ros/parsed.h"

namespace live_stiffness {

class InputStatus {
 public:
  // name: for log lines, such as "chamber_pressures".
  explicit InputStatus(std::string name) : name_(std::move(name)) {}

  // Call it for a readable message with this stamp (zero: it has none). Clears the last error and returns the stamp to use:
  // its own, or the time of arrival if it has none or if another clock wrote it (more than ten seconds behind ROS time, or
  // half a second ahead). None if the message must be left out, because the previous one was newer by at most a second. If
  // it was newer by more, a clock was set, as when a driver or a bag restarts.
  std::optional<ros::Time> accept(const ros::Time& stamp, const ros::Time& now = ros::Time::now());
  // Call it for a message that cannot be used: error() is the reason until the next good one.
  void reject(const std::string& error);
  // Counts an error, and logs it at most once a second.
  void logError(const std::string& error);
  // Counts, by sequence numbers, the messages that were lost before this one, in the publisher's queue or in ours.
  void countLost(const std::string& publisher, uint32_t sequence);

  // Age of the last good message by its stamp, s. It grows while none comes, and is large at once if messages are late. A very
  // large number before the first message, and after ROS time has jumped back.
  double age(const ros::Time& now = ros::Time::now()) const;
  bool hasMessage() const { return has_message_; }
  // Forgets ages and rates if ROS time jumped back, as when a bag is played in a loop. Call it regularly.
  void checkClock(const ros::Time& now = ros::Time::now());
  // Forgets ages and rates.
  void restart();

  const std::string& name() const { return name_; }
  // Why the newest message cannot be used; empty if it can.
  const std::string& error() const { return error_; }
  // A warning about the newest messages, which can be used nevertheless; empty if there is none.
  std::string warning() const;
  // Messages lost since the last call.
  long newlyLost();
  long accepted() const { return accepted_; }
  long rejected() const { return rejected_; }
  long outOfOrder() const { return out_of_order_; }
  double meanRate() const;                           // of good messages without the longest gap, 1/s; 0: too few
  double longestGap() const { return longest_gap_; }  // between the arrivals of two good ones, s
  const ros::Time& gapStart() const { return gap_start_; }
  // What was wrong with messages so far, a line for each kind: for a report at the end.
  std::vector<std::string> report() const;
  // Adds rate and counts to a diagnostics entry.
  void addCounts(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  bool arrivesInOrder(const ros::Time& stamp);
  ros::Time stampFor(const ros::Time& stamp, const ros::Time& now);

  std::string name_, error_, first_error_;
  bool has_message_ = false;              // since the start, or since time jumped back
  ros::Time last_accepted_, last_stamp_;  // when the last good message arrived, and the stamp used for it
  ros::Time last_own_stamp_;              // stamp in the newest message
  ros::WallTime error_logged_, stamp_logged_, overtaken_;
  double rate_ = 0.0;            // of good messages, 1/s, smoothed
  double foreign_offset_ = 0.0;  // of the newest stamp from ROS time, s; 0: the same clock
  double first_foreign_offset_ = 0.0, longest_gap_ = 0.0;  // s
  ros::Time gap_start_, first_accepted_;
  long accepted_ = 0, rejected_ = 0, out_of_order_ = 0, foreign_ = 0, lost_ = 0, lost_before_ = 0;
  std::string publisher_;  // of the newest numbered message
  uint32_t sequence_ = 0;  // its number
};

// Status of a topic whose numbers drive a robot, pressures or rod lengths: also checks their number.
class ArrayStatus : public InputStatus {
 public:
  struct Settings {
    std::string topic;
    std::string noun;      // in messages: "pressures"
    std::string counted;   // what `count` counts: "channels"
    std::string hint;      // added to the message when the count is wrong; may be empty
    int count = 0;           // that is right; 0: any, but always the same
    double timeout = 0.5;    // s, after which they are stale
    bool spare = false;      // more are right, too
  };
  explicit ArrayStatus(Settings settings) : InputStatus(settings.topic), settings_(std::move(settings)) {}

  // True if a message of this publisher can be used; `parsed` then has the stamp to use for it. Else error() has the reason,
  // or the message is left out as out of order.
  bool accept(Parsed<Eigen::VectorXd>& parsed, const std::string& publisher);
  // Changes the number that is required; spare: more are right, too.
  void setCount(int count, bool spare) { settings_.count = count, settings_.spare = spare; }
  int count() const { return settings_.count; }
  bool isStale() const { return age() > settings_.timeout; }
  // solver_error: why the newest ones cannot be solved; missing: what is known of why there are none; doubt: about good ones.
  // All are empty if there is nothing to say.
  void diagnose(const std::string& solver_error, const std::string& missing, const std::string& doubt,
                diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  Settings settings_;
};

}  // namespace live_stiffness
