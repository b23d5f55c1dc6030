#pragma once
// Health of one input: how old its newest good message is, how fast it comes, and what was wrong with the last bad one.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/time.h>

#include <chrono>
#include <string>

namespace live_stiffness {

class InputWatch {
 public:
  // name: for log lines, such as "chamber_pressures".
  explicit InputWatch(std::string name) : name_(std::move(name)) {}

  // A good message arrived at `now` that tells the state at `stamp`, as stampFor() gives it.
  void accept(const ros::Time& now, const ros::Time& stamp);
  void accept(const ros::Time& now) { accept(now, now); }
  // A bad one arrived: logged at most once a second, kept for diagnostics.
  void reject(const std::string& fault);

  // The stamp to use for a message: its own, or `now` when it has none or another clock wrote it (more than ten seconds
  // before `now`, or half a second after); the latter is kept for diagnostics and logged once a minute.
  ros::Time stampFor(const ros::Time& stamp, const ros::Time& now);
  // False, and counted, if a message with the stamp it came with was overtaken by the one before: up to a second older.
  // Older still is a clock that was set, as when a driver or a bag begins again.
  bool arrivesInOrder(const ros::Time& stamp);
  // Forgets everything but counts if time jumped back, as when a bag is played in a loop. Call it now and then.
  void notice(const ros::Time& now);

  // True at most once a second, first a second after the start: to subscribe anew, which must not be so often that no
  // connection is made between.
  bool mayRetry();

  // A message of a publisher that numbers them: counts those that were lost between it and the one before, in the
  // publisher's queue or in ours.
  void number(const std::string& publisher, uint32_t sequence);
  long lost() const { return lost_; }

  bool everAccepted() const { return accepted_ > 0; }
  // Seconds since what the last good message tells was true: grows while none comes, and is large at once if they come
  // late. A very large number before the first and after time jumped back.
  double age(const ros::Time& now) const;
  // Adds rate and counts to a diagnostics entry.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  long foreignStamps() const { return foreign_stamps_; }
  // What is odd about the newest messages although they can be used; empty: nothing.
  std::string oddity() const;
  // The last fault if it is newer than the last good message, else empty.
  const std::string& currentFault() const { return current_fault_; }
  const std::string& name() const { return name_; }
  // Forgets ages and rates.
  void restart();

 private:
  std::string name_, current_fault_;
  ros::Time last_accepted_, last_stamp_;  // when the last good message arrived, and the stamp used for it
  ros::Time last_raw_stamp_;              // that the newest message came with
  ros::WallTime fault_logged_, stamp_logged_, overtaken_;
  std::chrono::steady_clock::time_point retried_ = std::chrono::steady_clock::now();
  double rate_ = 0.0;           // of good messages, 1/s, smoothed
  double foreign_offset_ = 0.0;  // of the newest stamp from ROS time, s; 0: of the same clock
  long accepted_ = 0, rejected_ = 0, foreign_stamps_ = 0, out_of_order_ = 0, lost_ = 0;
  std::string publisher_;  // of the newest numbered message
  uint32_t sequence_ = 0;   // that it gave it
};

}  // namespace live_stiffness
