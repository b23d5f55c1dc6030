// Services of a StiffnessNode about the newest estimate: ~predict_deflection, ~compliance_at, ~directional_stiffness. They have
// their own workspace, so that the live solver is not affected.

#include "live_stiffness/analysis/directional_stiffness.h"
#include "live_stiffness/analysis/generalised_compliance.h"
#include "ros/stiffness_node.h"

namespace live_stiffness {
namespace {

constexpr char kOtherShape[] =
    "the robot is in another stable shape than the one it takes from rest, which alone can be solved for";

}  // namespace

template <class Response, class Answer>
bool StiffnessNode::reply(Response& response, Answer answer) {
  const EstimateSnapshot newest = snapshot();
  solver_.setModel(newest.model);
  if (newest.estimate == nullptr) {
    response.message = "nothing solved yet: waiting for usable pressures";
  } else {
    response.stale = newest.stale;
    response.header = toHeader(newest.stamp, parameters_.frames.base);
    response.message = answer(*newest.estimate);
    response.success = response.message.empty();
  }
  return true;
}

bool StiffnessNode::predictDeflection(PredictDeflection::Request& request, PredictDeflection::Response& response) {
  return reply(response, [&](const Estimate& estimate) -> std::string {
    const Parsed<Wrench> wrench = readWrench(request.wrench, parameters_.frames, &estimate.solution.X_BT);
    if (!wrench.ok()) return wrench.error;
    const DeflectionCheck check =
        checkDeflection(solver_.model(), estimate.effective, estimate.tip_wrench, wrench.value, solver_.workspace());
    if (check.undeflected_ok && !isSameEquilibrium(check.undeflected, estimate.solution.X_BT, solver_.model()))
      return kOtherShape;
    if (check.undeflected_ok && !check.predicted.twist.allFinite())
      return "wrench of " + numberText(wrench.value.norm()) + " N: the deflection must be finite";
    fillDeflection(check, response);
    if (check.status.ok()) return "";
    return (check.undeflected_ok ? "under the wrench: " : "") + solver_.model().describe(check.status);
  });
}

bool StiffnessNode::complianceAt(ComplianceAt::Request& request, ComplianceAt::Response& response) {
  return reply(response, [&](const Estimate& estimate) -> std::string {
    FaultList faults("compliance_at");
    faults.check("segment", request.segment, {0.0, solver_.model().scene().segmentCount() - 1.0});
    faults.check("fraction", request.fraction, {0.0, 1.0});
    if (!faults.empty()) return oneLine(faults.faults());
    solver_.workspace().reset();
    const StiffnessSolution solution =
        solver_.model().solve(estimate.effective, estimate.tip_wrench, solver_.workspace());
    if (!solution.status.ok()) return solver_.model().describe(solution.status);
    if (!isSameEquilibrium(solution.X_BT, estimate.solution.X_BT, solver_.model())) return kOtherShape;
    const GeneralisedCompliance tangent(solver_.model(), solver_.workspace(), estimate.tip_wrench,
                                        {{request.segment, request.fraction}});
    const Matrix6 C = tangent.between(0, 0);
    if (!tangent.ok() || !C.allFinite()) return "no tangent compliance: the robot is at its buckling load";
    const Station station = solver_.model().station(solver_.workspace(), request.segment, request.fraction);
    response.pose = toPose(station.X_BQ);
    response.stretch = station.stretch;
    copyRowByRow(C, response.compliance);
    copyRowByRow(station.compliance, response.material_compliance);
    return "";
  });
}

bool StiffnessNode::directionalStiffness(DirectionalStiffness::Request& request,
                                         DirectionalStiffness::Response& response) {
  return reply(response, [&](const Estimate& estimate) -> std::string {
    const Parsed<Matrix3> axes = readAxes(request.frame_id, parameters_.frames, &estimate.solution.X_BT);
    if (!axes.ok()) return axes.error;
    const Parsed<Vector3> direction = readVector(request.direction, "direction"),
                           offset = readVector(request.offset, "offset");
    if (!direction.ok()) return direction.error;
    if (!offset.ok()) return offset.error;
    const double length = direction.value.stableNorm();
    if (!(length > 0.0)) return "direction = [0, 0, 0]: must not be zero; its length does not matter";
    const Line line{axes.value * offset.value, axes.value * (direction.value / length)};
    const Matrix6 &C = estimate.solution.compliance, &K = estimate.stiffness;
    const Eigen::Vector4d stiffness(freeStiffnessAlong(C, line), constrainedStiffnessAlong(K, line),
                                    freeStiffnessAbout(C, line), constrainedStiffnessAbout(K, line));
    if (!stiffness.allFinite())
      return "offset of " + numberText(offset.value.stableNorm()) + " m: stiffness is not finite there";
    response.free_along = stiffness[0];
    response.constrained_along = stiffness[1];
    response.free_about = stiffness[2];
    response.constrained_about = stiffness[3];
    return "";
  });
}

}  // namespace live_stiffness
