#include "ros/stiffness_services.h"

#include <cmath>

#include "live_stiffness/analysis/directional_stiffness.h"
#include "live_stiffness/analysis/generalised_compliance.h"

namespace live_stiffness {
namespace {

constexpr char kOtherShape[] =
    "the robot is in another stable shape than the one it takes from rest, which alone can be solved for";

// Fills the common fields of all answers. False, with the reason, if there is no estimate.
template <class Response>
bool begin(const EstimateSnapshot& newest, const std::string& frame, Response& response) {
  response.success = false;
  if (newest.estimate == nullptr) {
    response.message = "nothing solved yet: waiting for usable pressures";
    return false;
  }
  response.stale = newest.stale;
  response.header.stamp = newest.stamp;
  response.header.frame_id = frame;
  return true;
}

template <class Response>
bool refuse(const std::string& error, Response& response) {
  response.message = error;
  return true;
}

template <class Response>
bool accept(Response& response) {
  response.success = true;
  return true;
}

}  // namespace

StiffnessServices::StiffnessServices(ros::NodeHandle private_node, FrameNames frames,
                                     GetSnapshot get_snapshot)
    : frames_(std::move(frames)), get_snapshot_(std::move(get_snapshot)) {
  servers_ = {
      private_node.advertiseService("predict_deflection", &StiffnessServices::predictDeflection, this),
      private_node.advertiseService("compliance_at", &StiffnessServices::complianceAt, this),
      private_node.advertiseService("directional_stiffness", &StiffnessServices::directionalStiffness, this)};
}

bool StiffnessServices::predictDeflection(PredictDeflection::Request& request, PredictDeflection::Response& response) {
  const EstimateSnapshot newest = get_snapshot_();
  solver_.setModel(newest.model);
  if (!begin(newest, frames_.base, response)) return true;
  const Estimate& estimate = *newest.estimate;
  const Parsed<Wrench> wrench = readWrench(request.wrench, frames_, &estimate.solution.X_BT);
  if (!wrench.ok()) return refuse(wrench.error, response);
  const DeflectionCheck check =
      checkDeflection(solver_.model(), estimate.effective, estimate.tip_wrench, wrench.value, solver_.workspace());
  if (check.undeflected_ok && !isSameEquilibrium(check.undeflected, estimate.solution.X_BT, solver_.model()))
    return refuse(kOtherShape, response);
  if (check.undeflected_ok && !check.predicted.twist.allFinite())
    return refuse("wrench of " + numberText(wrench.value.norm()) + " N: the deflection must be finite", response);
  fillDeflection(check, response);
  if (!check.status.ok())
    return refuse((check.undeflected_ok ? "under the wrench: " : "") + solver_.model().describe(check.status), response);
  return accept(response);
}

bool StiffnessServices::complianceAt(ComplianceAt::Request& request, ComplianceAt::Response& response) {
  const EstimateSnapshot newest = get_snapshot_();
  solver_.setModel(newest.model);
  if (!begin(newest, frames_.base, response)) return true;
  FaultList faults("compliance_at");
  faults.check("segment", request.segment, {0.0, solver_.model().scene().segmentCount() - 1.0});
  faults.check("fraction", request.fraction, {0.0, 1.0});
  if (!faults.empty()) return refuse(oneLine(faults.faults()), response);
  const Estimate& estimate = *newest.estimate;
  solver_.workspace().reset();
  const StiffnessSolution solution = solver_.model().solve(estimate.effective, estimate.tip_wrench, solver_.workspace());
  if (!solution.status.ok()) return refuse(solver_.model().describe(solution.status), response);
  if (!isSameEquilibrium(solution.X_BT, estimate.solution.X_BT, solver_.model())) return refuse(kOtherShape, response);
  const GeneralisedCompliance tangent(solver_.model(), solver_.workspace(), estimate.tip_wrench,
                                      {{request.segment, request.fraction}});
  const Matrix6 C = tangent.between(0, 0);
  if (!tangent.ok() || !C.allFinite()) return refuse("no tangent compliance: the robot is at its buckling load", response);
  const Station station = solver_.model().station(solver_.workspace(), request.segment, request.fraction);
  response.pose = toPose(station.X_BQ);
  response.stretch = station.stretch;
  copyRowByRow(C, response.compliance);
  copyRowByRow(station.compliance, response.material_compliance);
  return accept(response);
}

bool StiffnessServices::directionalStiffness(DirectionalStiffness::Request& request,
                                             DirectionalStiffness::Response& response) {
  const EstimateSnapshot newest = get_snapshot_();
  solver_.setModel(newest.model);
  if (!begin(newest, frames_.base, response)) return true;
  const Estimate& estimate = *newest.estimate;
  const Parsed<Matrix3> axes = readAxes(request.frame_id, frames_, &estimate.solution.X_BT);
  if (!axes.ok()) return refuse(axes.error, response);
  const Parsed<Vector3> direction = readVector(request.direction, "direction"),
                         offset = readVector(request.offset, "offset");
  if (!direction.ok()) return refuse(direction.error, response);
  if (!offset.ok()) return refuse(offset.error, response);
  const double length = direction.value.stableNorm();
  if (!(length > 0.0)) return refuse("direction = [0, 0, 0]: must not be zero; its length does not matter", response);
  const Line line{axes.value * offset.value, axes.value * (direction.value / length)};
  const Matrix6 &C = estimate.solution.compliance, &K = estimate.stiffness;
  response.free_along = freeStiffnessAlong(C, line);
  response.constrained_along = constrainedStiffnessAlong(K, line);
  response.free_about = freeStiffnessAbout(C, line);
  response.constrained_about = constrainedStiffnessAbout(K, line);
  for (double* value : {&response.free_along, &response.constrained_along, &response.free_about,
                        &response.constrained_about}) {
    if (std::isfinite(*value)) continue;
    response.free_along = response.constrained_along = response.free_about = response.constrained_about = 0.0;
    return refuse("offset of " + numberText(offset.value.stableNorm()) + " m: stiffness is not finite there", response);
  }
  return accept(response);
}

}  // namespace live_stiffness
