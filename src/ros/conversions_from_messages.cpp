#include "ros/conversions.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <live_stiffness/RodLengths.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Float64MultiArray.h>

#include <cmath>

#include "ros/short_allocator.h"

namespace live_stiffness {
namespace {

constexpr double kFarthest = 1000.0;  // m; beyond any tracker's reach, in millimetres too

template <class Array>
Pressures toVectorXd(const Array& array) {
  Pressures values(array.size());
  for (size_t k = 0; k < array.size(); ++k) values[k] = array[k];
  return values;
}

template <class Value>
Reading<Value> faulty(const std::string& fault) {
  Reading<Value> reading;
  reading.fault = fault;
  return reading;
}

using Short = ShortAllocator<void>;  // of messages with arrays

// The message; nullptr, and a fault, if its bytes are cut short, claim more numbers than any robot has, or belong to
// another version of the type.
template <class Message, class Value>
boost::shared_ptr<Message> decode(const topic_tools::ShapeShifter& message, Reading<Value>& reading) {
  try {
    if (message.size() > 0) return message.instantiate<Message>();  // of no bytes roscpp would count from a null pointer
  } catch (const std::exception&) {
  }
  reading.fault = "message is damaged, or of another version of " + message.getDataType();
  return nullptr;
}

std::string pressureFault(double value, const PressureFormat& format) {
  if (!std::isfinite(value)) return "is " + numberText(value) + ": must be finite";
  if (format.absolute && value < 0.0)
    return "is " + numberText(value) + ": an absolute pressure must not be negative; is it gauge? "
           "(set ~pressure_reference: gauge)";
  return "";
}

// Numbers of a stamped message with a `field` for them.
template <class Stamped, class Array>
Reading<Eigen::VectorXd> readStamped(const Stamped& message, Array Stamped::*field) {
  Reading<Eigen::VectorXd> reading;
  reading.stamp = message.header.stamp;
  reading.sequence = message.header.seq;
  reading.value = toVectorXd(message.*field);
  return reading;
}

// The same, or of a bare array.
template <class Stamped, class Array>
Reading<Eigen::VectorXd> readArray(const topic_tools::ShapeShifter& message, Array Stamped::*field) {
  Reading<Eigen::VectorXd> reading;
  const std::string &type = message.getDataType(), own_type = ros::message_traits::DataType<Stamped>::value();
  if (type == own_type) {
    if (const auto typed = decode<Stamped>(message, reading)) return readStamped(*typed, field);
  } else if (type == "std_msgs/Float64MultiArray") {
    if (const auto typed = decode<std_msgs::Float64MultiArray_<Short>>(message, reading))
      reading.value = toVectorXd(typed->data);
  } else if (type == "std_msgs/Float32MultiArray") {
    if (const auto typed = decode<std_msgs::Float32MultiArray_<Short>>(message, reading))
      reading.value = toVectorXd(typed->data);
  } else {
    reading.fault = "message type " + type + ": must be " + own_type +
                    ", std_msgs/Float64MultiArray or std_msgs/Float32MultiArray";
  }
  return reading;
}

Reading<TrackedPose> checkedPose(const ros::Time& stamp, const std::string& frame, const geometry_msgs::Point& p,
                                 const geometry_msgs::Quaternion& q, double position_unit) {
  const Vector3 position(p.x, p.y, p.z);
  const Eigen::Quaterniond rotation(q.w, q.x, q.y, q.z);
  if (!position.allFinite() || !rotation.coeffs().allFinite())
    return faulty<TrackedPose>("pose is not finite: the tracker does not see its sensor");
  if (position_unit * position.norm() > kFarthest)
    return faulty<TrackedPose>("position is " + numberText(position_unit * position.norm()) +
                               " m away: must be within " + numberText(kFarthest) + " m");
  const double norm = rotation.norm();
  if (norm < 1e-6) return faulty<TrackedPose>("quaternion is zero: the tracker does not see its sensor");
  if (std::abs(norm - 1.0) > 0.05)
    return faulty<TrackedPose>("quaternion has length " + numberText(norm) + ": must be 1");
  Reading<TrackedPose> reading;
  reading.stamp = stamp;
  reading.value = {{rotation.normalized().toRotationMatrix(), position_unit * position}, withoutSlash(frame)};
  return reading;
}

Reading<Pressures> gaugePressures(Reading<Pressures> reading, const PressureFormat& format) {
  for (int k = 0; k < reading.value.size() && reading.ok(); ++k) {
    const std::string fault = pressureFault(reading.value[k], format);
    if (!fault.empty()) reading.fault = "pressure of channel " + std::to_string(k + 1) + " " + fault;
    reading.value[k] = format.gauge(reading.value[k]);
  }
  return reading;
}

Reading<Eigen::VectorXd> metres(Reading<Eigen::VectorXd> reading, double unit) {
  for (int i = 0; i < reading.value.size() && reading.ok(); ++i)
    if (!std::isfinite(reading.value[i]))
      reading.fault =
          "length of rod " + std::to_string(i + 1) + " is " + numberText(reading.value[i]) + ": must be finite";
  reading.value *= unit;
  return reading;
}

}  // namespace

double pascalsPerUnit(const std::string& unit) {
  if (unit == "Pa") return 1.0;
  if (unit == "kPa") return 1e3;
  if (unit == "bar") return 1e5;
  if (unit == "mbar") return 1e2;
  if (unit == "psi") return 6894.757293168361;
  return 0.0;
}

bool isWhole(const topic_tools::ShapeShifter& message) {
  const std::string& type = message.getDataType();
  Reading<double> unused;
  if (type == "live_stiffness/ChamberPressures") return decode<ChamberPressures_<Short>>(message, unused) != nullptr;
  if (type == "live_stiffness/RodLengths") return decode<RodLengths_<Short>>(message, unused) != nullptr;
  if (type == "geometry_msgs/PoseStamped") return decode<geometry_msgs::PoseStamped>(message, unused) != nullptr;
  return false;
}

Reading<Pressures> readPressures(const topic_tools::ShapeShifter& message, const PressureFormat& format) {
  return gaugePressures(readArray(message, &ChamberPressures_<Short>::pressure), format);
}

Reading<Pressures> readPressures(const ChamberPressures& message, const PressureFormat& format) {
  return gaugePressures(readStamped(message, &ChamberPressures::pressure), format);
}

Reading<Eigen::VectorXd> readRodLengths(const topic_tools::ShapeShifter& message, double unit) {
  return metres(readArray(message, &RodLengths_<Short>::length), unit);
}

Reading<Eigen::VectorXd> readRodLengths(const RodLengths& message, double unit) {
  return metres(readStamped(message, &RodLengths::length), unit);
}

Reading<double> readPressure(const sensor_msgs::FluidPressure& message, const PressureFormat& format) {
  Reading<double> reading;
  reading.stamp = message.header.stamp;
  reading.value = format.gauge(message.fluid_pressure);
  const std::string fault = pressureFault(message.fluid_pressure, format);
  if (!fault.empty()) reading.fault = "pressure " + fault;
  return reading;
}

Reading<TrackedPose> readPose(const topic_tools::ShapeShifter& message, double position_unit) {
  Reading<TrackedPose> reading;
  const std::string& type = message.getDataType();
  if (type == "geometry_msgs/PoseStamped") {
    if (const auto typed = decode<geometry_msgs::PoseStamped>(message, reading)) return readPose(*typed, position_unit);
  } else if (type == "geometry_msgs/PoseWithCovarianceStamped") {
    if (const auto typed = decode<geometry_msgs::PoseWithCovarianceStamped>(message, reading))
      return checkedPose(typed->header.stamp, typed->header.frame_id, typed->pose.pose.position,
                         typed->pose.pose.orientation, position_unit);
  } else if (type == "geometry_msgs/TransformStamped") {
    if (const auto typed = decode<geometry_msgs::TransformStamped>(message, reading))
      return readPose(*typed, position_unit);
  } else {
    reading.fault = "message type " + type + ": must be geometry_msgs/PoseStamped, "
                    "geometry_msgs/PoseWithCovarianceStamped or geometry_msgs/TransformStamped";
  }
  return reading;
}

Reading<TrackedPose> readPose(const geometry_msgs::PoseStamped& message, double position_unit) {
  return checkedPose(message.header.stamp, message.header.frame_id, message.pose.position, message.pose.orientation,
                     position_unit);
}

Reading<TrackedPose> readPose(const geometry_msgs::TransformStamped& message, double position_unit) {
  geometry_msgs::Point position;
  position.x = message.transform.translation.x;
  position.y = message.transform.translation.y;
  position.z = message.transform.translation.z;
  return checkedPose(message.header.stamp, message.header.frame_id, position, message.transform.rotation,
                     position_unit);
}

Reading<Pose> readPose(const geometry_msgs::Pose& message) {
  const Reading<TrackedPose> checked = checkedPose(ros::Time(), "", message.position, message.orientation, 1.0);
  if (!checked.ok()) return faulty<Pose>("pose must be finite, with a quaternion of length 1");
  return {checked.stamp, checked.value.pose, ""};
}

Reading<Matrix3> readAxes(const std::string& frame, const FrameNames& frames, const Pose* X_BT) {
  const std::string name = withoutSlash(frame);
  if (name.empty() || name == frames.base) return {ros::Time(), Matrix3::Identity(), ""};
  if (name != frames.body)
    return faulty<Matrix3>("unknown frame " + name + ": must be " + frames.base +
                           (frames.body.empty() ? "" : " or " + frames.body));
  if (X_BT == nullptr) return faulty<Matrix3>("the axes of " + name + " are not known before the first estimate");
  return {ros::Time(), X_BT->R, ""};
}

Reading<Wrench> readWrench(const geometry_msgs::WrenchStamped& message, const FrameNames& frames, const Pose* X_BT) {
  Reading<Wrench> reading;
  reading.stamp = message.header.stamp;
  const geometry_msgs::Vector3 &f = message.wrench.force, &m = message.wrench.torque;
  reading.value << f.x, f.y, f.z, m.x, m.y, m.z;
  if (!reading.value.allFinite()) return faulty<Wrench>("wrench is not finite: six finite numbers, N and N m");
  const Reading<Matrix3> axes = readAxes(message.header.frame_id, frames, X_BT);
  reading.fault = axes.fault;
  if (axes.ok()) reading.value = wrenchAdjoint({axes.value, Vector3::Zero()}) * reading.value;
  return reading;
}

Reading<Vector3> readVector(const geometry_msgs::Vector3& message, const std::string& name) {
  const Vector3 value(message.x, message.y, message.z);
  if (!value.allFinite())
    return faulty<Vector3>(name + " = [" + numberText(value.x()) + ", " + numberText(value.y()) + ", " +
                           numberText(value.z()) + "]: must be three finite numbers");
  return {ros::Time(), value, ""};
}

std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace live_stiffness
