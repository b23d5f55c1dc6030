#pragma once
// Health of one input: how old its newest good message is, how fast it comes, and what was wrong with the last bad one.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/time.h>

#include <string>

namespace live_stiffness {

class InputWatch {
 public:
  // name: for log lines, such as "chamber_pressures".
  explicit InputWatch(std::string name) : name_(std::move(name)) {}

  // A good message arrived at `now`.
  void accept(const ros::Time& now);
  // A bad one arrived: logged at most once a second, kept for diagnostics.
  void reject(const std::string& fault);

  // The stamp to use for a message: its own, or `now` when it has none or a device's own clock wrote it (more than
  // ten seconds from `now`); the latter is counted and logged once a minute.
  ros::Time stampFor(const ros::Time& stamp, const ros::Time& now);

  // A message of a publisher that numbers them: counts those that were lost between it and the one before, in the
  // publisher's queue or in ours.
  void number(const std::string& publisher, uint32_t sequence);
  long lost() const { return lost_; }

  bool everAccepted() const { return accepted_ > 0; }
  // Seconds since the last good message; a very large number before the first. Negative after time jumped back.
  double age(const ros::Time& now) const;
  // Adds rate and counts to a diagnostics entry.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  long foreignStamps() const { return foreign_stamps_; }
  // The last fault if it is newer than the last good message, else empty.
  const std::string& currentFault() const { return current_fault_; }
  const std::string& name() const { return name_; }
  // Forgets ages and rates, after time jumped back.
  void restart();

 private:
  std::string name_, current_fault_;
  ros::Time last_accepted_;
  ros::WallTime fault_logged_, stamp_logged_;
  double rate_ = 0.0;  // of good messages, 1/s, smoothed
  long accepted_ = 0, rejected_ = 0, foreign_stamps_ = 0, lost_ = 0;
  std::string publisher_;   // of the newest message
  uint32_t sequence_ = 0;   // that it gave it
};

}  // namespace live_stiffness
