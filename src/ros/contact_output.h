#pragma once
// Estimate of the external wrench at the tip: its topics, markers and diagnostics.

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <live_stiffness/TipContact.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>

#include "live_stiffness/estimation/tip_wrench_estimator.h"
#include "ros/markers.h"
#include "ros/node_parameters.h"

namespace live_stiffness {

class ContactOutput {
 public:
  // Advertises ~tip_wrench_estimate and ~tip_contact. parameters must outlive this.
  ContactOutput(ros::NodeHandle private_node, const NodeParameters& parameters);

  // A tracker pose: estimates and publishes. pressures: newest, gauge, Pa, one per chamber; known: the known wrench
  // at T; measured_X_BT: nullptr if the tracker has lost its sensor, and then the estimate is only predicted.
  void update(PressuresRef pressures, const Wrench& known, const Pose* measured_X_BT, const ros::Time& stamp);
  // Forgets the past; call it after a change of the registration.
  void reset() { estimator_->reset(); }
  // Another scene or other options.
  void setEstimator(std::unique_ptr<TipWrenchEstimator> estimator) { estimator_ = std::move(estimator); }

  // False too when the newest estimate is older than pose_timeout.
  bool inContact() const;
  // Arrow of the force at the tip, during contact.
  visualization_msgs::MarkerArray markers(const MarkerStyle& style, const ros::Time& stamp) const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  // Largest standard deviation of the force along any direction, N.
  double forceDeviation() const;

  const NodeParameters& parameters_;
  std::unique_ptr<TipWrenchEstimator> estimator_;
  ros::Time updated_;  // when the newest estimate was made
  std::string error_;  // why the newest pose gave no estimate; empty: it did
  ros::Publisher wrench_publisher_, contact_publisher_;
};

}  // namespace live_stiffness
