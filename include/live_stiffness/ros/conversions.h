#pragma once
// Every translation between ROS messages and the core's types. Nothing else in the package touches message fields.

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <live_stiffness/ChamberPressures.h>
#include <live_stiffness/StiffnessEstimate.h>
#include <live_stiffness/TrackingError.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/FluidPressure.h>
#include <topic_tools/shape_shifter.h>

#include <string>

#include "live_stiffness/estimation/stiffness_estimator.h"

namespace live_stiffness {

// A message read into the core's types, or the reason why it could not be.
template <class Value>
struct Reading {
  ros::Time stamp;  // zero when the message has none
  Value value;
  std::string fault;  // empty: value holds

  bool ok() const { return fault.empty(); }
};

// How a rig writes pressures down.
struct PressureFormat {
  double unit = 1.0;  // Pa per unit of the message
  bool absolute = false;
  double atmosphere = kAtmospherePa;  // subtracted from absolute ones, Pa

  double gauge(double value) const { return value * unit - (absolute ? atmosphere : 0.0); }
};

// Pa per unit for Pa, kPa, bar, mbar, psi; 0 for any other name.
double pascalsPerUnit(const std::string& unit);

// Gauge pressures (Pa) of all channels from ChamberPressures, std_msgs/Float64MultiArray or Float32MultiArray.
// Faults: another type, a value that is not finite, a negative absolute pressure.
Reading<Pressures> readPressures(const topic_tools::ShapeShifter& message, const PressureFormat& format);
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
Reading<TrackedPose> readPose(const geometry_msgs::TransformStamped& message, double position_unit);

// [f; m] as it stands in the message, in the axes of its frame.
Reading<Wrench> readWrench(const geometry_msgs::WrenchStamped& message);

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
nav_msgs::Path toPath(const std::vector<Station>& stations, const Pose& X_BT, const ros::Time& stamp,
                      const std::string& frame);
// residual: twist that takes the predicted pose to the measured one.
TrackingError toTrackingError(const Pose& measured, const Pose& predicted, const Twist& residual,
                              const ros::Time& stamp, const std::string& frame);

}  // namespace live_stiffness
