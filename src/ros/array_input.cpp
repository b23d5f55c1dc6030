#include "ros/array_input.h"

#include <ros/master.h>

namespace live_stiffness {

using diagnostic_msgs::DiagnosticStatus;

ArrayInput::ArrayInput(const ros::NodeHandle& node, Settings settings, Subscribe subscribe, OnValues on_values,
                       OnFault on_fault)
    : node_(node),
      settings_(std::move(settings)),
      subscribe_(std::move(subscribe)),
      on_values_(std::move(on_values)),
      on_fault_(std::move(on_fault)),
      watch_(settings_.topic) {
  if (subscribe_) this->subscribe();
}

void ArrayInput::subscribe() {
  subscriber_.shutdown();  // first, else the new one shares its connections and with them the type
  subscriber_ = subscribe_(node_, settings_.topic,
                           [this](const Reading<Eigen::VectorXd>& reading, const std::string& publisher) {
                             take(reading, publisher);
                           });
}

void ArrayInput::tend() {
  watch_.notice(ros::Time::now());
  if (subscribe_ && isStale() && subscriber_.getNumPublishers() == 0 && watch_.mayRetry() && ros::master::check())
    subscribe();  // which without a master would wait for one
}

void ArrayInput::take(const Reading<Eigen::VectorXd>& reading, const std::string& publisher) {
  if (reading.sequence) watch_.number(publisher, *reading.sequence);
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
  const long lost = watch_.lost() - lost_before_;
  lost_before_ = watch_.lost();
  if (!watch_.currentFault().empty())
    status.summary(DiagnosticStatus::ERROR, watch_.currentFault());
  else if (!watch_.everAccepted())
    status.summary(DiagnosticStatus::ERROR, "no " + settings_.noun + " received yet");
  else if (isStale())
    status.summaryf(DiagnosticStatus::ERROR, "%s are stale: %.1f s old", settings_.noun.c_str(),
                    watch_.age(ros::Time::now()));
  else if (!watch_.oddity().empty())
    status.summary(DiagnosticStatus::WARN, watch_.oddity());
  else if (lost > 0)
    status.summaryf(DiagnosticStatus::WARN, "%ld messages lost since the last report: they come faster than they are taken",
                    lost);
  else
    status.summary(DiagnosticStatus::OK, "ok");
  watch_.report(status);
}

}  // namespace live_stiffness
