#pragma once
// The numbers that drive a robot, pressures or rod lengths, from one topic of whatever type: how many there must be,
// how old they are, and what was wrong with them.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "ros/any_subscriber.h"
#include "ros/conversions.h"
#include "ros/input_watch.h"

namespace live_stiffness {

class ArrayInput {
 public:
  struct Settings {
    std::string topic;
    std::string noun;         // for people: "pressures"
    std::string counted;      // what there must be `count` of: "channels"
    std::string hint;         // added where the count is wrong; may be empty
    int count = 0;
    double timeout = 0.5;     // s
  };
  using Take = std::function<void(const Reading<Eigen::VectorXd>& reading, const std::string& publisher)>;
  using Subscribe = std::function<ros::Subscriber(const ros::NodeHandle& node, const std::string& topic, const Take& take)>;
  // Subscribes to messages of type Own or any other that read(message) takes.
  template <class Own, class Read>
  static Subscribe subscribeTo(Read read);
  using OnValues = std::function<void(const Eigen::VectorXd& values, const ros::Time& stamp)>;
  using OnFault = std::function<void(const std::string& fault)>;

  // Calls on_values with each usable array, and on_fault with the reason for each that is not. Without `subscribe`
  // nothing is subscribed to, and arrays come through take() alone.
  ArrayInput(const ros::NodeHandle& node, Settings settings, Subscribe subscribe, OnValues on_values,
             OnFault on_fault);
  ArrayInput(const ArrayInput&) = delete;  // callbacks refer to it

  // publisher: its name.
  void take(const Reading<Eigen::VectorXd>& reading, const std::string& publisher);
  // From now on there must be so many.
  void expect(int count) { settings_.count = count; }
  // A solve found that the newest values cannot be used after all.
  void reject(const std::string& fault) { watch_.reject(fault); }
  bool isStale() const;
  // Call now and then: a subscriber keeps the type of its first publisher, so it is renewed when that one is gone.
  void tend();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  static constexpr int kQueue = 100;  // enough for a tenth of a second of 1 kHz

  void subscribe();

  ros::NodeHandle node_;
  Settings settings_;
  Subscribe subscribe_;
  OnValues on_values_;
  OnFault on_fault_;
  InputWatch watch_;
  long lost_before_ = 0;  // as of the last diagnosis
  ros::Subscriber subscriber_;
};

template <class Own, class Read>
ArrayInput::Subscribe ArrayInput::subscribeTo(Read read) {
  return [read](const ros::NodeHandle& node, const std::string& topic, const Take& take) {
    const auto on_any = [read, take](const auto& message, const std::string& publisher) {
      take(read(message), publisher);
    };
    return subscribeAny<Own>(node, topic, kQueue, on_any, on_any);
  };
}

}  // namespace live_stiffness
