#pragma once
// Services of stiffness_node about the newest estimate: ~predict_deflection, ~compliance_at, ~directional_stiffness. They have
// their own workspace, so that the live solver is not affected.

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

  // Always return true; a request that cannot be fulfilled gets success = false.
  bool predictDeflection(PredictDeflection::Request& request, PredictDeflection::Response& response);
  bool complianceAt(ComplianceAt::Request& request, ComplianceAt::Response& response);
  bool directionalStiffness(DirectionalStiffness::Request& request, DirectionalStiffness::Response& response);

 private:
  // Fills what all answers have. answer: fills the rest for the newest estimate; returns why it cannot, empty if it can.
  template <class Response, class Answer>
  bool reply(Response& response, Answer answer);

  FrameNames frames_;
  GetSnapshot get_snapshot_;
  ModelWorkspace solver_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace live_stiffness
