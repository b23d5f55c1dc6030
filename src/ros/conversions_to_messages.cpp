#include "ros/conversions.h"

namespace live_stiffness {
namespace {

template <class Message>
Message toXyz(const Vector3& v) {
  Message message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

}  // namespace

std_msgs::Header toHeader(const ros::Time& stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame;
  return header;
}

geometry_msgs::Point toPoint(const Vector3& p) { return toXyz<geometry_msgs::Point>(p); }
geometry_msgs::Vector3 toVector(const Vector3& v) { return toXyz<geometry_msgs::Vector3>(v); }

geometry_msgs::Wrench toWrench(const Wrench& wrench) {
  geometry_msgs::Wrench message;
  message.force = toVector(linear(wrench));
  message.torque = toVector(angular(wrench));
  return message;
}

geometry_msgs::Quaternion toQuaternion(const Matrix3& R) {
  Eigen::Quaterniond q(R);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  geometry_msgs::Quaternion quaternion;
  quaternion.w = q.w();
  quaternion.x = q.x();
  quaternion.y = q.y();
  quaternion.z = q.z();
  return quaternion;
}

geometry_msgs::Pose toPose(const Pose& X) {
  geometry_msgs::Pose pose;
  pose.position = toPoint(X.p);
  pose.orientation = toQuaternion(X.R);
  return pose;
}

geometry_msgs::TransformStamped toTransform(const Pose& X, const ros::Time& stamp, const std::string& parent,
                                            const std::string& child) {
  geometry_msgs::TransformStamped transform;
  transform.header = toHeader(stamp, parent);
  transform.child_frame_id = child;
  transform.transform.translation = toVector(X.p);
  transform.transform.rotation = toQuaternion(X.R);
  return transform;
}

geometry_msgs::PoseStamped toPoseStamped(const Pose& X, const ros::Time& stamp, const std::string& frame) {
  geometry_msgs::PoseStamped pose;
  pose.header = toHeader(stamp, frame);
  pose.pose = toPose(X);
  return pose;
}

ChamberPressures toPressures(PressuresRef pressures, const ros::Time& stamp) {
  ChamberPressures message;
  message.header.stamp = stamp;
  message.pressure.assign(pressures.data(), pressures.data() + pressures.size());
  return message;
}

geometry_msgs::WrenchStamped toWrenchStamped(const Wrench& wrench, const ros::Time& stamp, const std::string& frame) {
  geometry_msgs::WrenchStamped message;
  message.header = toHeader(stamp, frame);
  message.wrench = toWrench(wrench);
  return message;
}

StiffnessEstimate toEstimate(const Estimate& estimate, const ros::Time& stamp, const std::string& frame) {
  StiffnessEstimate message;
  fillEstimate(estimate, estimate.tip_ellipsoid, stamp, frame, message);
  message.tip_pose = toPose(estimate.solution.X_BT);
  message.pressure.assign(estimate.pressures.data(), estimate.pressures.data() + estimate.pressures.size());
  message.tip_wrench = toWrench(estimate.tip_wrench);
  message.stretch = estimate.stretch;
  return message;
}

void fillDeflection(const DeflectionCheck& check, PredictDeflection::Response& response) {
  response.predicted = check.undeflected_ok;
  if (!check.undeflected_ok) return;
  response.undeflected = toPose(check.undeflected);
  response.deflection = toTwist(check.predicted.twist);
  response.linear = toPose(check.predicted.linear);
  response.exponential = toPose(check.predicted.exponential);
  if (!check.status.ok()) return;
  response.exact = toPose(check.exact);
  response.linear_position_error = check.linear_error.position;
  response.linear_rotation_error = check.linear_error.rotation;
  response.exponential_position_error = check.exponential_error.position;
  response.exponential_rotation_error = check.exponential_error.rotation;
}

TipContact toTipContact(const TipWrenchEstimate& estimate, const Wrench& known, const std::string& error,
                        const ros::Time& stamp, const std::string& frame) {
  TipContact contact;
  contact.header = toHeader(stamp, frame);
  contact.contact = estimate.contact;
  contact.outlier = estimate.outlier;
  contact.tracked = estimate.tracked;
  contact.message = error;
  contact.wrench = toWrench(estimate.wrench);
  copyRowByRow(estimate.covariance, contact.covariance);
  contact.known_wrench = toWrench(known);
  contact.stiffness_scale = estimate.stiffness_scale;
  contact.stiffness_scale_deviation = estimate.stiffness_scale_deviation;
  contact.tip_pose = toPose(estimate.X_BT);
  copyRowByRow(estimate.solution.compliance, contact.compliance);
  contact.model_error = toTwist(estimate.model_error);
  contact.innovation = estimate.innovation;
  return contact;
}

void fillRegistration(const LiveRegistration& result, Register::Response& response) {
  const RegistrationFit& fit = result.fit;
  response.fitted = true;
  response.base_in_tracker = toPose(fit.registration.X_AB);
  response.sensor_on_tip = toPose(fit.registration.X_TS);
  response.base_rotation_determined = fit.base_rotation_determined;
  response.sensor_offset_determined = fit.sensor_offset_determined;
  response.weakest_sensitivity = fit.weakest_sensitivity;
  response.advice = fit.advice();
  response.samples = result.used;
  response.outliers = result.outliers;
  response.span = result.span;
  response.position_mean = fit.position.mean;
  response.position_rms = fit.position.rms;
  response.position_p95 = fit.position.p95;
  response.position_max = fit.position.max;
  response.rotation_mean = fit.rotation.mean;
  response.rotation_rms = fit.rotation.rms;
  response.rotation_p95 = fit.rotation.p95;
  response.rotation_max = fit.rotation.max;
}

geometry_msgs::Twist toTwist(const Twist& twist) {
  geometry_msgs::Twist message;
  message.linear = toVector(linear(twist));
  message.angular = toVector(angular(twist));
  return message;
}

nav_msgs::Path toPath(const std::vector<Station>& stations, const Pose& X_BT, const ros::Time& stamp,
                      const std::string& frame) {
  nav_msgs::Path path;
  path.header = toHeader(stamp, frame);
  for (const Station& station : stations) path.poses.push_back(toPoseStamped(station.X_BQ, stamp, frame));
  path.poses.push_back(toPoseStamped(X_BT, stamp, frame));
  return path;
}

TrackingError toTrackingError(const Pose& measured, const Pose& predicted, const Twist& residual,
                              const ros::Time& stamp, const std::string& frame) {
  TrackingError error;
  error.header = toHeader(stamp, frame);
  error.measured = toPose(measured);
  error.predicted = toPose(predicted);
  error.translation = toVector(linear(residual));
  error.rotation = toVector(angular(residual));
  error.distance = linear(residual).norm();
  error.angle = angular(residual).norm();
  return error;
}

}  // namespace live_stiffness
