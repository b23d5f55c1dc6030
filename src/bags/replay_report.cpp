#include "bags/replay_report.h"

#include <sstream>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

void addRow(const TopicReport& topic, std::ostream& out) {
  out << "| " << topic.name << " | " << topic.usable << " | " << topic.unusable << " | " << numberText(topic.rate)
      << " | " << numberText(topic.longest_gap) << " at " << numberText(topic.gap_start) << " | " << topic.backward
      << " |\n";
}

}  // namespace

std::string ReplayReport::text(const std::string& bag, double accuracy) const {
  std::ostringstream out;
  out.precision(3);
  out << "# " << bag << "\n\n"
      << duration << " s of bag in " << wall_time << " s, " << duration / wall_time << " times real time.\n\n"
      << "| topic | usable | unusable | rate, Hz | longest gap, s, at s | stamps going back |\n"
      << "|---|---|---|---|---|---|\n";
  for (const TopicReport* topic : {&pressures, &poses, &wrenches}) addRow(*topic, out);
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
