#include "ros/contact_output.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace live_stiffness {

using diagnostic_msgs::DiagnosticStatus;

ContactOutput::ContactOutput(ros::NodeHandle private_node, const NodeParameters& parameters)
    : parameters_(parameters),
      estimator_(std::make_unique<TipWrenchEstimator>(parameters.scene, parameters.model, parameters.contact)),
      wrench_publisher_(private_node.advertise<geometry_msgs::WrenchStamped>("tip_wrench_estimate", 10)),
      contact_publisher_(private_node.advertise<TipContact>("tip_contact", 10)) {}

void ContactOutput::update(PressuresRef pressures, const Wrench& known, const Pose* measured_X_BT,
                           const ros::Time& stamp) {
  estimator_->setKnownWrench(known);
  const bool updated = measured_X_BT != nullptr ? estimator_->update(pressures, *measured_X_BT, stamp.toSec())
                                                : estimator_->predict(pressures, stamp.toSec());
  error_ = estimator_->statusText();
  if (!updated) return;
  updated_ = ros::Time::now();
  const TipWrenchEstimate& estimate = *estimator_->estimate();
  const std::string& frame = parameters_.frames.base;
  wrench_publisher_.publish(toWrenchStamped(known + estimate.wrench, stamp, frame));
  contact_publisher_.publish(toTipContact(estimate, known, error_, stamp, frame));
}

bool ContactOutput::inContact() const {
  const TipWrenchEstimate* estimate = estimator_->estimate();
  return estimate != nullptr && estimate->contact &&
         std::abs(secondsBetween(updated_, ros::Time::now())) <= parameters_.pose_timeout;  // time may have jumped back
}

double ContactOutput::forceDeviation() const {
  const Matrix3 covariance = estimator_->estimate()->covariance.topLeftCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues().maxCoeff()));
}

visualization_msgs::MarkerArray ContactOutput::markers(const MarkerStyle& style, const ros::Time& stamp) const {
  if (!inContact()) return {};
  const TipWrenchEstimate& estimate = *estimator_->estimate();
  return makeContactMarkers(estimate.X_BT.p, linear(estimate.wrench), forceDeviation(), parameters_.contact_arrow_scale,
                            style, stamp);
}

void ContactOutput::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (estimator_->estimate() == nullptr) {
    status.summary(error_.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   error_.empty() ? "no tracker pose to estimate from" : error_);
    return;
  }
  const TipWrenchEstimate& estimate = *estimator_->estimate();
  const double force = linear(estimate.wrench).norm();
  if (!error_.empty()) status.summary(DiagnosticStatus::WARN, error_);
  else if (inContact()) status.summaryf(DiagnosticStatus::OK, "contact, %.2f N", force);
  else status.summary(DiagnosticStatus::OK, "no contact");
  status.add("force (N)", force);
  status.add("force, standard deviation (N)", forceDeviation());
  status.add("stiffness scale", estimate.stiffness_scale);
  status.add("model error (mm)", 1e3 * linear(estimate.model_error).norm());
  status.add("innovation (standard deviations)", estimate.innovation);
}

}  // namespace live_stiffness
