#pragma once
// Where estimates go: to topics, live, or to a bag.

#include <geometry_msgs/WrenchStamped.h>
#include <live_stiffness/StiffnessEstimate.h>
#include <live_stiffness/TipContact.h>
#include <live_stiffness/TrackingError.h>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

class EstimateOutput {
 public:
  virtual ~EstimateOutput() = default;
  // X_BT: the estimated pose of T; nullptr if the estimate is stale.
  virtual void onEstimate(const StiffnessEstimate::ConstPtr& estimate, const Pose* X_BT) = 0;
  virtual void onTrackingError(const TrackingError& error) = 0;
  virtual void onContact(const TipContact& contact, const geometry_msgs::WrenchStamped& wrench) = 0;
};

}  // namespace live_stiffness
