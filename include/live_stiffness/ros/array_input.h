#pragma once
// The numbers that drive a robot, pressures or rod lengths, from one topic of whatever type: how many there must be,
// how old they are, and what was wrong with them.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "live_stiffness/ros/conversions.h"
#include "live_stiffness/ros/input_watch.h"

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
  using Read = std::function<Reading<Eigen::VectorXd>(const topic_tools::ShapeShifter& message)>;
  using OnValues = std::function<void(const Eigen::VectorXd& values, const ros::Time& stamp)>;
  using OnFault = std::function<void(const std::string& fault)>;

  // Calls on_values with each usable array, and on_fault with the reason for each that is not. Without `read` nothing
  // is subscribed to, and arrays come through take() alone.
  ArrayInput(ros::NodeHandle node, Settings settings, Read read, OnValues on_values, OnFault on_fault);
  ArrayInput(const ArrayInput&) = delete;  // callbacks refer to it

  void take(const Reading<Eigen::VectorXd>& reading);
  // A solve found that the newest values cannot be used after all.
  void reject(const std::string& fault) { watch_.reject(fault); }
  bool isStale() const;
  // Call now and then: a subscriber keeps the type of its first publisher, so it is renewed when that one is gone.
  void tend();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  void subscribe();
  void onMessage(const topic_tools::ShapeShifter::ConstPtr& message) { take(read_(*message)); }

  ros::NodeHandle node_;
  Settings settings_;
  Read read_;
  OnValues on_values_;
  OnFault on_fault_;
  InputWatch watch_;
  ros::Subscriber subscriber_;
};

}  // namespace live_stiffness
