#pragma once
// The questions that stiffness_node answers: ~predict_deflection, ~compliance_at, ~directional_stiffness. Each is
// answered for the newest estimate, in a workspace of its own, so that the live solver stays as it is.

#include <live_stiffness/ComplianceAt.h>
#include <live_stiffness/DirectionalStiffness.h>
#include <live_stiffness/PredictDeflection.h>
#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "ros/conversions.h"
#include "ros/estimate_snapshot.h"

namespace live_stiffness {

class StiffnessServices {
 public:
  // Advertises them.
  StiffnessServices(ros::NodeHandle private_node, FrameNames frames, GetSnapshot get_snapshot);
  StiffnessServices(const StiffnessServices&) = delete;  // callbacks refer to it

  // The answers; always true, since a question that cannot be answered has success = false.
  bool predictDeflection(PredictDeflection::Request& request, PredictDeflection::Response& response);
  bool complianceAt(ComplianceAt::Request& request, ComplianceAt::Response& response);
  bool directionalStiffness(DirectionalStiffness::Request& request, DirectionalStiffness::Response& response);

 private:
  FrameNames frames_;
  GetSnapshot get_snapshot_;
  ModelWorkspace solver_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace live_stiffness
