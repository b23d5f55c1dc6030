#pragma once
// From messages of a tracker to tracking errors and the external wrench at the tip. The node feeds it from topics, replay from a
// bag; it knows no subscriber, and its time is ros::Time::now().

#include <memory>
#include <optional>
#include <string>

#include "live_stiffness/estimation/tip_wrench_estimator.h"
#include "ros/estimate_updater.h"
#include "ros/tracker_input.h"

namespace live_stiffness {

class TipComparison {
 public:
  // Both must outlive this.
  TipComparison(const NodeParameters& parameters, EstimateOutput& output);

  TrackerInput& tracker() { return tracker_; }
  // A pose of the sensor that the tracker read; state: of the robot at its time. Without a registration nothing is put out. A
  // pose that repeats the one before is no measurement: the wrench is then only predicted.
  void compare(const Parsed<Pose>& X_AS, const KnownState& state);

  // Forgets the past; call it after a change of the registration.
  void reset();
  // Another scene or other options; must not be null.
  void replaceFilter(std::unique_ptr<TipWrenchEstimator> filter) { filter_ = std::move(filter); }

  // The newest measured pose of T in B; none if it is not fresh, or the robot is not registered.
  std::optional<Pose> freshTip() const;
  // The estimate of the wrench, during contact and while fresh; else nullptr.
  const TipWrenchEstimate* contact() const;
  void diagnoseTracker(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseContact(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  void estimateWrench(const KnownState& state, const Pose* measured_X_BT, const ros::Time& stamp);

  const NodeParameters& parameters_;
  EstimateOutput& output_;
  TrackerInput tracker_;
  std::unique_ptr<TipWrenchEstimator> filter_;
  std::optional<Pose> X_BT_;      // newest measured
  double tracking_error_ = 0.0;   // newest distance, m
  ros::Time filtered_;            // when the newest estimate of the wrench was made
  std::string filter_error_;      // why the newest pose gave no estimate; empty: it did
};

// Largest standard deviation of the force along any direction, N.
double forceDeviation(const TipWrenchEstimate& estimate);

}  // namespace live_stiffness
