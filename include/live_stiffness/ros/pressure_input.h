#pragma once
// Chamber pressures from whatever topics a rig publishes.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <vector>

#include "live_stiffness/ros/conversions.h"
#include "live_stiffness/ros/input_watch.h"
#include "live_stiffness/ros/node_parameters.h"

namespace live_stiffness {

class PressureInput {
 public:
  using OnPressures = std::function<void(const Pressures& chamber_pressures, const ros::Time& stamp)>;
  using OnFault = std::function<void(const std::string& fault)>;

  // Calls on_pressures with gauge pressures (Pa), one per chamber, and on_fault with the reason for each message that
  // cannot be used. parameters must outlive the input.
  PressureInput(ros::NodeHandle node, const NodeParameters& parameters, OnPressures on_pressures, OnFault on_fault);

  // A solve found that the newest pressures cannot be used after all.
  void reject(const std::string& fault) { watch_.reject(fault); }
  bool isStale() const;
  // Call now and then: a subscriber keeps the type of its first publisher, so it is renewed when that one is gone.
  void tend();
  int channelCount() const { return channel_map_.channelCount(); }
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  void subscribe();
  bool allHeard(const ros::Time& now) const;
  void onMessage(const topic_tools::ShapeShifter::ConstPtr& message);
  void onChannel(const sensor_msgs::FluidPressure::ConstPtr& message, size_t channel);
  void take(const Reading<Pressures>& channels);

  ros::NodeHandle node_;
  const NodeParameters& parameters_;
  OnPressures on_pressures_;
  OnFault on_fault_;
  ChannelMap channel_map_;
  InputWatch watch_;
  Pressures channels_;            // newest of each of pressure_topics
  std::vector<ros::Time> heard_;  // when each of them was last heard to be good; zero: not since its last fault
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace live_stiffness
