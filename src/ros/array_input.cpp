#include "live_stiffness/ros/array_input.h"

namespace live_stiffness {

using diagnostic_msgs::DiagnosticStatus;

ArrayInput::ArrayInput(ros::NodeHandle node, Settings settings, Read read, OnValues on_values, OnFault on_fault)
    : node_(std::move(node)),
      settings_(std::move(settings)),
      read_(std::move(read)),
      on_values_(std::move(on_values)),
      on_fault_(std::move(on_fault)),
      watch_(settings_.topic) {
  if (read_) subscribe();
}

void ArrayInput::subscribe() {
  subscriber_.shutdown();  // first, else the new one shares its connections and with them the type
  subscriber_ = node_.subscribe(settings_.topic, 10, &ArrayInput::onMessage, this);
}

void ArrayInput::tend() {
  watch_.notice(ros::Time::now());
  if (read_ && isStale() && subscriber_.getNumPublishers() == 0) subscribe();
}

void ArrayInput::take(const Reading<Eigen::VectorXd>& reading) {
  std::string fault = reading.fault;
  if (fault.empty() && reading.value.size() != settings_.count)
    fault = std::to_string(reading.value.size()) + " " + settings_.counted + ": must be " +
            std::to_string(settings_.count) + settings_.hint;
  if (!fault.empty()) {
    watch_.reject(fault);
    on_fault_(fault);
    return;
  }
  const ros::Time now = ros::Time::now();
  watch_.notice(now);
  if (!watch_.arrivesInOrder(reading.stamp)) return;
  const ros::Time stamp = watch_.stampFor(reading.stamp, now);
  watch_.accept(now, stamp);
  on_values_(reading.value, stamp);
}

bool ArrayInput::isStale() const { return watch_.age(ros::Time::now()) > settings_.timeout; }

void ArrayInput::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (!watch_.currentFault().empty())
    status.summary(DiagnosticStatus::ERROR, watch_.currentFault());
  else if (!watch_.everAccepted())
    status.summary(DiagnosticStatus::ERROR, "no " + settings_.noun + " received yet");
  else if (isStale())
    status.summaryf(DiagnosticStatus::ERROR, "%s are stale: %.1f s old", settings_.noun.c_str(),
                    watch_.age(ros::Time::now()));
  else if (!watch_.oddity().empty())
    status.summary(DiagnosticStatus::WARN, watch_.oddity());
  else
    status.summary(DiagnosticStatus::OK, "ok");
  watch_.report(status);
}

}  // namespace live_stiffness
