#pragma once
// From messages of pressures and known wrenches to estimates. The node feeds it from topics, replay from a bag; it knows no
// subscriber, and its time is ros::Time::now().

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimation/motion_history.h"
#include "ros/estimate_output.h"
#include "ros/node_parameters.h"
#include "ros/pressure_input.h"
#include "ros/wrench_input.h"

namespace live_stiffness {

// The robot as the model knew it when a tracker saw it.
struct KnownState {
  bool is_known = false;  // false: nothing but newest_wrench holds
  Moment then;
  Wrench solved_wrench = Wrench::Zero(), newest_wrench = Wrench::Zero();  // at T, base axes; of the estimate, and newest
};

class EstimateUpdater {
 public:
  // Both must outlive this. Throws ConfigurationError on a scene or options that cannot be used.
  EstimateUpdater(const NodeParameters& parameters, EstimateOutput& output);

  // A message: solves and puts out what follows from it. Returns the pressures of the chambers; none if it cannot be used.
  std::optional<Parsed<Pressures>> onPressures(const topic_tools::ShapeShifter& message, const std::string& publisher);
  // channel: its place in ~pressure_topics.
  std::optional<Parsed<Pressures>> onChannelPressure(const sensor_msgs::FluidPressure& message, size_t channel);
  void onTipWrench(const geometry_msgs::WrenchStamped& message);
  // To be called at ~heartbeat_hz: looks at what has become old, and solves again.
  void onHeartbeat();

  void setPaused(bool is_paused);
  bool isPaused() const { return is_paused_; }
  // Takes a new estimator, of the scene that the parameters now have. keeps_inputs: solves at once for the pressures and the
  // wrench of the one before, if they suit; else nothing is known.
  void replaceEstimator(std::shared_ptr<StiffnessEstimator> estimator, bool keeps_inputs);

  // Why the estimate does not belong to the newest pressures; empty if it does.
  std::string newestError() const;
  bool isStale() const { return !newestError().empty() || pressures_.status().isStale(); }
  // delay: of the tracker, s; stamp: of its pose.
  KnownState stateAt(const ros::Time& stamp, double delay) const;

  const std::shared_ptr<StiffnessEstimator>& estimator() const { return estimator_; }
  const ros::Time& stamp() const { return estimate_stamp_; }  // of the pressures of the last good estimate
  PressureInput& pressures() { return pressures_; }
  WrenchInput& wrenches() { return wrenches_; }
  long failures() const { return failures_; }  // solves that gave no estimate
  const std::string& firstFailure() const { return first_failure_; }

 private:
  std::optional<Parsed<Pressures>> use(std::optional<Parsed<Pressures>> channels);
  void onSolved(StiffnessEstimator::Outcome outcome);
  void putOut();

  const NodeParameters& parameters_;
  EstimateOutput& output_;
  std::shared_ptr<StiffnessEstimator> estimator_;
  PressureInput pressures_;
  WrenchInput wrenches_;
  MotionHistory history_;
  ros::Time pressure_stamp_;  // of the newest usable pressures
  ros::Time estimate_stamp_;
  bool is_paused_ = false;
  long failures_ = 0;
  std::string first_failure_;
};

}  // namespace live_stiffness
