#pragma once
// Every translation between ROS messages and the core's types. Nothing else in the package touches message fields.

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <live_stiffness/ChamberPressures.h>
#include <live_stiffness/PlatformEstimate.h>
#include <live_stiffness/PredictDeflection.h>
#include <live_stiffness/Register.h>
#include <live_stiffness/RodLengths.h>
#include <live_stiffness/StiffnessEstimate.h>
#include <live_stiffness/TipContact.h>
#include <live_stiffness/TrackingError.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/FluidPressure.h>
#include <topic_tools/shape_shifter.h>

#include <optional>
#include <string>

#include "live_stiffness/analysis/deflection.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/estimation/parallel_estimator.h"
#include "estimation/registration_buffer.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "live_stiffness/estimation/tip_wrench_estimator.h"

namespace live_stiffness {

// A message read into the core's types, or the reason why it could not be.
template <class Value>
struct Reading {
  ros::Time stamp;  // zero when the message has none
  Value value;
  std::string fault;  // empty: value holds
  std::optional<uint32_t> sequence = {};  // that the publisher gave the message, if it numbers them

  bool ok() const { return fault.empty(); }
};

// frame_id of tip_force_torque. Of the simulated rig: at T, with axes of T, in the sense "on the robot".
constexpr char kForceSensorFrame[] = "tip_force_sensor";

// How a rig writes pressures down.
struct PressureFormat {
  double unit = 1.0;  // Pa per unit of the message
  bool absolute = false;
  double atmosphere = kAtmospherePa;  // subtracted from absolute ones, Pa

  double gauge(double value) const { return value * unit - (absolute ? atmosphere : 0.0); }
};

// Pa per unit for Pa, kPa, bar, mbar, psi; 0 for any other name.
double pascalsPerUnit(const std::string& unit);

// Whether the bytes are a whole ChamberPressures, RodLengths or PoseStamped; false for any other type.
bool isWhole(const topic_tools::ShapeShifter& message);

// Gauge pressures (Pa) of all channels from ChamberPressures, std_msgs/Float64MultiArray or Float32MultiArray.
// Faults: another type, a value that is not finite, a negative absolute pressure.
Reading<Pressures> readPressures(const topic_tools::ShapeShifter& message, const PressureFormat& format);
Reading<Pressures> readPressures(const ChamberPressures& message, const PressureFormat& format);
// Rod lengths (m) from RodLengths or an array as above; unit: m per unit of the message. Faults: another type, a value
// that is not finite.
Reading<Eigen::VectorXd> readRodLengths(const topic_tools::ShapeShifter& message, double unit);
Reading<Eigen::VectorXd> readRodLengths(const RodLengths& message, double unit);
// Gauge pressure (Pa) of one channel.
Reading<double> readPressure(const sensor_msgs::FluidPressure& message, const PressureFormat& format);

// Where the tracker saw its sensor: pose in `frame`, which has no leading slash.
struct TrackedPose {
  Pose pose;
  std::string frame;
};
// From PoseStamped, PoseWithCovarianceStamped or TransformStamped; position_unit: m per unit of the message.
// Faults: another type, values that are not finite, a zero or far from unit quaternion.
Reading<TrackedPose> readPose(const topic_tools::ShapeShifter& message, double position_unit);
Reading<TrackedPose> readPose(const geometry_msgs::PoseStamped& message, double position_unit);
Reading<TrackedPose> readPose(const geometry_msgs::TransformStamped& message, double position_unit);

// Faults: as above.
Reading<Pose> readPose(const geometry_msgs::Pose& message);

// Frames that a message may name its axes by: the fixed one and, unless empty, that of the body which the robot moves.
struct FrameNames {
  std::string base, body;
};
// Rotation from the axes of `frame` to base axes. X_BT: of the body; nullptr: not known yet. Faults: an unknown frame,
// a pose that is not known yet.
Reading<Matrix3> readAxes(const std::string& frame, const FrameNames& frames, const Pose* X_BT);

// [f; m] in base axes. Faults: values that are not finite, and those of readAxes().
Reading<Wrench> readWrench(const geometry_msgs::WrenchStamped& message, const FrameNames& frames, const Pose* X_BT);

// Three numbers. Faults, by `name`: values that are not finite.
Reading<Vector3> readVector(const geometry_msgs::Vector3& message, const std::string& name);

// "/aurora" -> "aurora"
std::string withoutSlash(const std::string& frame);

geometry_msgs::Point toPoint(const Vector3& p);
geometry_msgs::Vector3 toVector(const Vector3& v);
geometry_msgs::Quaternion toQuaternion(const Matrix3& R);  // w >= 0
geometry_msgs::Pose toPose(const Pose& X);
geometry_msgs::TransformStamped toTransform(const Pose& X, const ros::Time& stamp, const std::string& parent,
                                            const std::string& child);
ChamberPressures toPressures(PressuresRef pressures, const ros::Time& stamp);
geometry_msgs::PoseStamped toPoseStamped(const Pose& X, const ros::Time& stamp, const std::string& frame);
geometry_msgs::WrenchStamped toWrenchStamped(const Wrench& wrench, const ros::Time& stamp, const std::string& frame);
StiffnessEstimate toEstimate(const Estimate& estimate, const ros::Time& stamp, const std::string& frame);
PlatformEstimate toEstimate(const ParallelEstimate& estimate, const ros::Time& stamp, const std::string& frame);
// The deflection, as far as it was found; success, message, stale and header stay.
void fillDeflection(const DeflectionCheck& check, PredictDeflection::Response& response);

// known: the wrench at T that the model is given; fault: what is wrong, empty if nothing.
TipContact toTipContact(const TipWrenchEstimate& estimate, const Wrench& known, const std::string& fault,
                        const ros::Time& stamp, const std::string& frame);
// A fit; success, message, applied and saved_to stay.
void fillRegistration(const LiveRegistration& result, Register::Response& response);

// A 6x6 matrix, row by row.
template <class Array>
void copyRowByRow(const Matrix6& matrix, Array& array) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) array[6 * i + j] = matrix(i, j);
}

// The truth about how good the values of an estimate (StiffnessEstimate, PlatformEstimate) still are. code: of the
// newest solve; fault: why the estimate is not that of the newest input, empty if it is; is_silent: no input for longer
// than timeout (s), which is of these `inputs`.
template <class Message>
void setStanding(SolveCode code, const std::string& fault, bool is_silent, double timeout, const std::string& inputs,
                 Message& message) {
  message.status = static_cast<uint8_t>(code);
  message.stale = is_silent || !fault.empty();
  message.message = fault;
  if (code == SolveCode::kOk && !fault.empty())
    message.status = Message::INVALID_INPUT;  // the message could not even be read
  if (message.stale && fault.empty()) message.message = "no " + inputs + " for more than " + numberText(timeout) + " s";
}
geometry_msgs::Twist toTwist(const Twist& twist);
nav_msgs::Path toPath(const std::vector<Station>& stations, const Pose& X_BT, const ros::Time& stamp,
                      const std::string& frame);
// residual: twist that takes the predicted pose to the measured one.
TrackingError toTrackingError(const Pose& measured, const Pose& predicted, const Twist& residual,
                              const ros::Time& stamp, const std::string& frame);

}  // namespace live_stiffness
