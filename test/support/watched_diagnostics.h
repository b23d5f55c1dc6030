#pragma once
// What /diagnostics says of stiffness_node: the newest of each task.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>

#include <map>
#include <string>

namespace live_stiffness {

class WatchedDiagnostics {
 public:
  WatchedDiagnostics() : subscriber_(node_.subscribe("/diagnostics", 100, &WatchedDiagnostics::onMessage, this)) {}

  // 0 ok, 1 warn, 2 error; -1 before the first.
  int level(const std::string& task) const {
    const auto found = levels_.find("stiffness_node: " + task);
    return found == levels_.end() ? -1 : found->second;
  }
  std::string text(const std::string& task) const {
    const auto found = texts_.find("stiffness_node: " + task);
    return found == texts_.end() ? "" : found->second;
  }

 private:
  void onMessage(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    for (const auto& status : message->status) {
      levels_[status.name] = status.level;
      texts_[status.name] = status.message;
    }
  }

  std::map<std::string, int> levels_;
  std::map<std::string, std::string> texts_;
  ros::NodeHandle node_;
  ros::Subscriber subscriber_;
};

}  // namespace live_stiffness
