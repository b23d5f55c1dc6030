#pragma once
// Conversions between ROS messages and the core's types.

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <live_stiffness/ChamberPressures.h>
#include <live_stiffness/PredictDeflection.h>
#include <live_stiffness/Register.h>
#include <live_stiffness/RodLengths.h>
#include <live_stiffness/StiffnessEstimate.h>
#include <live_stiffness/TipContact.h>
#include <live_stiffness/TrackingError.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/FluidPressure.h>
#include <topic_tools/shape_shifter.h>

#include <string>

#include "estimation/input_parameters.h"
#include "live_stiffness/analysis/deflection.h"
#include "estimation/registration_buffer.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "live_stiffness/estimation/tip_wrench_estimator.h"
#include "ros/parsed.h"
#include "units.h"

namespace live_stiffness {

// frame_id of tip_force_torque. Of the simulated rig: at T, with axes of T, in the sense "on the robot".
constexpr char kForceSensorFrame[] = "tip_force_sensor";

// Gauge pressures (Pa) of all channels from ChamberPressures, std_msgs/Float64MultiArray or Float32MultiArray.
// Errors: another type, a damaged message, a value that is not finite, a negative absolute pressure.
Parsed<Pressures> readPressures(const topic_tools::ShapeShifter& message, const PressureFormat& format);
// Rod lengths (m) from RodLengths or an array as above; unit: m per unit of the message. Errors: another type, a damaged
// message, a value that is not finite.
Parsed<Eigen::VectorXd> readRodLengths(const topic_tools::ShapeShifter& message, double unit);
// Gauge pressure (Pa) of one channel.
Parsed<double> readPressure(const sensor_msgs::FluidPressure& message, const PressureFormat& format);

// A tracker pose in `frame`, of the sensor `child` if the message names it. Neither has a leading slash.
struct TrackedPose {
  Pose pose;
  std::string frame, child;
};
// From PoseStamped, PoseWithCovarianceStamped or TransformStamped; position_unit: m per unit of the message.
// Errors: another type, a damaged message, values that are not finite, a quaternion far from length 1.
Parsed<TrackedPose> readPose(const topic_tools::ShapeShifter& message, double position_unit);
Parsed<TrackedPose> readPose(const geometry_msgs::TransformStamped& message, double position_unit);

// Errors: as above.
Parsed<Pose> readPose(const geometry_msgs::Pose& message);

// Rotation from the axes of `frame` to base axes. X_BT: of the body; nullptr: not known yet. Errors: an unknown frame,
// a pose that is not known yet.
Parsed<Matrix3> readAxes(const std::string& frame, const FrameNames& frames, const Pose* X_BT);

// [f; m] in base axes. Errors: values that are not finite, and those of readAxes().
Parsed<Wrench> readWrench(const geometry_msgs::WrenchStamped& message, const FrameNames& frames, const Pose* X_BT);

// Three numbers. Errors, by `name`: values that are not finite.
Parsed<Vector3> readVector(const geometry_msgs::Vector3& message, const std::string& name);

std_msgs::Header toHeader(const ros::Time& stamp, const std::string& frame);
geometry_msgs::Point toPoint(const Vector3& p);
geometry_msgs::Vector3 toVector(const Vector3& v);
geometry_msgs::Wrench toWrench(const Wrench& wrench);
geometry_msgs::Quaternion toQuaternion(const Matrix3& R);  // w >= 0
geometry_msgs::Pose toPose(const Pose& X);
geometry_msgs::TransformStamped toTransform(const Pose& X, const ros::Time& stamp, const std::string& parent,
                                            const std::string& child);
ChamberPressures toPressures(PressuresRef pressures, const ros::Time& stamp);
geometry_msgs::PoseStamped toPoseStamped(const Pose& X, const ros::Time& stamp, const std::string& frame);
geometry_msgs::WrenchStamped toWrenchStamped(const Wrench& wrench, const ros::Time& stamp, const std::string& frame);
StiffnessEstimate toEstimate(const Estimate& estimate, const ros::Time& stamp, const std::string& frame);
// The deflection, as far as it was found; success, message, stale and header are not changed.
void fillDeflection(const DeflectionCheck& check, PredictDeflection::Response& response);

// known: the known wrench at T; error: what is wrong, or empty.
TipContact toTipContact(const TipWrenchEstimate& estimate, const Wrench& known, const std::string& error,
                        const ros::Time& stamp, const std::string& frame);
// A fit; success, message, applied and saved_to are not changed.
void fillRegistration(const LiveRegistration& result, Register::Response& response);

// A 6x6 matrix, row by row.
template <class Array>
void copyRowByRow(const Matrix6& matrix, Array& array) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(array.data()) = matrix;
}

// Fills what the estimates of all robots (StiffnessEstimate, PlatformEstimate) share. translation: their ellipsoid.
template <class Estimate, class Message>
void fillEstimate(const Estimate& estimate, const Ellipsoid& translation, const ros::Time& stamp,
                  const std::string& frame, Message& message) {
  message.header = toHeader(stamp, frame);
  copyRowByRow(estimate.solution.compliance, message.compliance);
  copyRowByRow(estimate.solution.material_compliance, message.material_compliance);
  copyRowByRow(estimate.stiffness, message.stiffness);
  for (int k = 0; k < 3; ++k) message.compliance_eigenvalues[k] = translation.half_axes[k];
  message.iterations = estimate.solution.iterations;
  message.solve_time = estimate.solve_time;
  message.numerical_error = estimate.solution.numerical_error;
}

// Fills their status, stale and message. code: of the newest solve; error: why the estimate is not that of the newest
// input, empty if it is; is_silent: no input for longer than timeout (s); inputs: their name.
template <class Message>
void setStatus(SolveCode code, const std::string& error, bool is_silent, double timeout, const std::string& inputs,
               Message& message) {
  message.status = static_cast<uint8_t>(code);
  message.stale = is_silent || !error.empty();
  message.message = error;
  if (code == SolveCode::kOk && !error.empty()) message.status = Message::INVALID_INPUT;  // the input could not be read
  if (message.stale && error.empty()) message.message = "no " + inputs + " for more than " + numberText(timeout) + " s";
}
geometry_msgs::Twist toTwist(const Twist& twist);
nav_msgs::Path toPath(const std::vector<Station>& stations, const Pose& X_BT, const ros::Time& stamp,
                      const std::string& frame);
// residual: twist that takes the predicted pose to the measured one.
TrackingError toTrackingError(const Pose& measured, const Pose& predicted, const Twist& residual,
                              const ros::Time& stamp, const std::string& frame);

}  // namespace live_stiffness
