#pragma once
// Chamber pressures from whatever topics a rig publishes.

#include <string>
#include <vector>

#include "ros/array_input.h"
#include "ros/node_parameters.h"

namespace live_stiffness {

class PressureInput {
 public:
  using OnPressures = ArrayInput::OnValues;  // gauge, Pa, one per chamber
  using OnFault = ArrayInput::OnFault;

  // Calls on_pressures with usable pressures, and on_fault with the reason for each message that cannot be used.
  // parameters must outlive the input.
  PressureInput(ros::NodeHandle node, const NodeParameters& parameters, OnPressures on_pressures, OnFault on_fault);

  // As those of ArrayInput.
  void reject(const std::string& fault) { input_.reject(fault); }
  bool isStale() const { return input_.isStale(); }
  void tend() { input_.tend(); }
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) { input_.diagnose(status); }
  // The parameters have another scene or channel_of_chamber.
  void adapt();
  int channelCount() const { return channel_map_.channelCount(); }

 private:
  bool allHeard(const ros::Time& now) const;
  void onChannel(const sensor_msgs::FluidPressure::ConstPtr& message, size_t channel);

  const NodeParameters& parameters_;
  ChannelMap channel_map_;
  ArrayInput input_;
  Pressures channels_;            // newest of each of pressure_topics
  std::vector<ros::Time> heard_;  // when each of them was last heard to be good; zero: not since its last fault
  std::vector<ros::Time> stamps_;  // of the newest message of each
  std::vector<ros::Subscriber> subscribers_;  // one for each of them
};

}  // namespace live_stiffness
