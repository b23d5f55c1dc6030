#include "ros/tip_comparison.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace live_stiffness {

using diagnostic_msgs::DiagnosticStatus;

namespace {

constexpr char kNotRegistered[] =
    "not registered: where the base is in the tracker's frame is not known, so no tracking error and no contact; call "
    "~register, or give registration_file";

}  // namespace

TipComparison::TipComparison(const NodeParameters& parameters, EstimateOutput& output)
    : parameters_(parameters),
      output_(output),
      tracker_(parameters, parameters.registration),
      filter_(std::make_unique<TipWrenchEstimator>(parameters.scene, parameters.model, parameters.contact)) {}

void TipComparison::compare(const Parsed<Pose>& X_AS, const KnownState& state) {
  if (!parameters_.is_registered || !state.is_known) return;
  const Registration& registration = parameters_.registration;
  const Pose& expected = state.then.X_BT;
  const Pose measured =
      registration.tipPose(completedPose(X_AS.value, registration.sensorPose(expected), tracker_.measures()));
  const bool is_repeated = tracker_.isRepeated();
  estimateWrench(state, is_repeated ? nullptr : &measured, X_AS.stamp);
  if (is_repeated) return;
  X_BT_ = measured;
  const Twist residual = residualTwist(measured, expected);
  tracking_error_ = linear(residual).norm();
  output_.onTrackingError(toTrackingError(measured, expected, residual, X_AS.stamp, parameters_.frames.base));
}

void TipComparison::estimateWrench(const KnownState& state, const Pose* measured_X_BT, const ros::Time& stamp) {
  const Wrench& known = state.solved_wrench;
  filter_->setKnownWrench(known);
  filter_->setMeasures(tracker_.measures());
  const bool updated = measured_X_BT != nullptr ? filter_->update(state.then.pressures, *measured_X_BT, stamp.toSec())
                                                : filter_->predict(state.then.pressures, stamp.toSec());
  filter_error_ = filter_->statusText();
  if (!updated) return;
  filtered_ = ros::Time::now();
  const TipWrenchEstimate& estimate = *filter_->estimate();
  const std::string& frame = parameters_.frames.base;
  output_.onContact(toTipContact(estimate, known, filter_error_, stamp, frame),
                    toWrenchStamped(known + estimate.wrench, stamp, frame));
}

void TipComparison::reset() {
  filter_->reset();
  X_BT_.reset();
}

std::optional<Pose> TipComparison::freshTip() const { return tracker_.isFresh() ? X_BT_ : std::nullopt; }

const TipWrenchEstimate* TipComparison::contact() const {
  const TipWrenchEstimate* estimate = filter_->estimate();
  const bool is_fresh = std::abs(secondsBetween(filtered_, ros::Time::now())) <= parameters_.pose_timeout;  // time may jump back
  return estimate != nullptr && estimate->contact && is_fresh ? estimate : nullptr;
}

double forceDeviation(const TipWrenchEstimate& estimate) {
  const Matrix3 covariance = estimate.covariance.topLeftCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues().maxCoeff()));
}

void TipComparison::diagnoseTracker(diagnostic_updater::DiagnosticStatusWrapper& status) {
  tracker_.diagnose(parameters_.is_registered ? "" : kNotRegistered, status);
  if (parameters_.is_registered) status.add("tracking error (mm)", 1e3 * tracking_error_);
}

void TipComparison::diagnoseContact(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (filter_->estimate() == nullptr && !parameters_.is_registered) {
    status.summary(DiagnosticStatus::WARN, kNotRegistered);
    return;
  }
  if (filter_->estimate() == nullptr) {
    status.summary(filter_error_.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   filter_error_.empty() ? "no tracker pose to estimate from" : filter_error_);
    return;
  }
  const TipWrenchEstimate& estimate = *filter_->estimate();
  const double force = linear(estimate.wrench).norm();
  if (!filter_error_.empty()) status.summary(DiagnosticStatus::WARN, filter_error_);
  else if (contact() != nullptr) status.summaryf(DiagnosticStatus::OK, "contact, %.2f N", force);
  else status.summary(DiagnosticStatus::OK, "no contact");
  status.add("force (N)", force);
  status.add("force, standard deviation (N)", forceDeviation(estimate));
  status.add("stiffness scale", estimate.stiffness_scale);
  status.add("model error (mm)", 1e3 * linear(estimate.model_error).norm());
  status.add("innovation (standard deviations)", estimate.innovation);
}

}  // namespace live_stiffness
