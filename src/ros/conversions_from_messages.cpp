#include "ros/conversions.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Float64MultiArray.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/plausibility.h"
#include "parameter_reader.h"

namespace live_stiffness {
namespace {

template <class Value>
Parsed<Value> failed(const std::string& error) {
  Parsed<Value> parsed;
  parsed.error = error;
  return parsed;
}

std::string damaged(const topic_tools::ShapeShifter& message) {
  return "message is damaged, or of another version of " + message.getDataType();
}

// A message without arrays; nullptr if bytes are missing, or belong to another version of the type.
template <class Message>
boost::shared_ptr<Message> decode(const topic_tools::ShapeShifter& message) {
  try {
    if (message.size() > 0) return message.instantiate<Message>();
  } catch (const ros::Exception&) {
  }
  return nullptr;
}

// Reads the bytes of a message with an array. roscpp's own deserialisation allocates memory for the number of entries that a
// message states before it checks that they are there, and a damaged message may state 4e9. All functions throw
// ros::Exception when the bytes end too early.
class ArrayBytes {
 public:
  explicit ArrayBytes(const topic_tools::ShapeShifter& message)
      : bytes_(std::max(message.size(), 1u)), stream_(bytes_.data(), message.size()) {
    ros::serialization::OStream out(bytes_.data(), bytes_.size());
    message.write(out);
  }

  template <class Field>
  Field next() {
    Field field;
    ros::serialization::deserialize(stream_, field);
    return field;
  }
  // A std_msgs/MultiArrayLayout: dimensions (label, size, stride), offset.
  void skipLayout() {
    constexpr uint32_t kSizes = 2 * sizeof(uint32_t);
    for (uint32_t i = next<uint32_t>(); i > 0; --i) {
      stream_.advance(next<uint32_t>());
      stream_.advance(kSizes);
    }
    stream_.advance(sizeof(uint32_t));
  }
  // The array that ends the message.
  template <class Number>
  Eigen::VectorXd numbers() {
    const uint32_t count = next<uint32_t>();
    if (count > stream_.getLength() / sizeof(Number)) throw ros::Exception("cut short");
    Eigen::VectorXd numbers(count);
    for (uint32_t k = 0; k < count; ++k) numbers[k] = next<Number>();
    return numbers;
  }

 private:
  std::vector<uint8_t> bytes_;
  ros::serialization::IStream stream_;
};

std::string pressureError(double value, const PressureFormat& format) {
  return pressureFault(value, format.isAbsolute(), format.gauge(value), kInputRemedies);
}

// Numbers of a Stamped (header and an array of float64), a Float64MultiArray or a Float32MultiArray.
template <class Stamped>
Parsed<Eigen::VectorXd> readArray(const topic_tools::ShapeShifter& message) {
  namespace traits = ros::message_traits;
  Parsed<Eigen::VectorXd> parsed;
  const std::string& md5 = message.getMD5Sum();
  try {
    ArrayBytes bytes(message);
    if (md5 == traits::md5sum<Stamped>()) {
      const auto header = bytes.next<std_msgs::Header>();
      parsed.stamp = header.stamp;
      parsed.sequence = header.seq;
      parsed.value = bytes.numbers<double>();
    } else if (md5 == traits::md5sum<std_msgs::Float64MultiArray>()) {
      bytes.skipLayout();
      parsed.value = bytes.numbers<double>();
    } else if (md5 == traits::md5sum<std_msgs::Float32MultiArray>()) {
      bytes.skipLayout();
      parsed.value = bytes.numbers<float>();
    } else if (message.getDataType() == traits::datatype<Stamped>()) {
      parsed.error = damaged(message);
    } else {
      parsed.error = "message type " + message.getDataType() + ": must be " + traits::datatype<Stamped>() +
                     ", std_msgs/Float64MultiArray or std_msgs/Float32MultiArray";
    }
  } catch (const ros::Exception&) {
    parsed.error = damaged(message);
  }
  return parsed;
}

// Of a geometry_msgs/Point or Vector3.
template <class Xyz>
Vector3 fromXyz(const Xyz& message) {
  return {message.x, message.y, message.z};
}

template <class Xyz>
Parsed<TrackedPose> checkedPose(const std_msgs::Header& header, const Xyz& p, const geometry_msgs::Quaternion& q,
                                double position_unit) {
  const Vector3 position = fromXyz(p);
  const Eigen::Quaterniond rotation(q.w, q.x, q.y, q.z);
  const std::string fault = poseFault(position_unit * position, rotation);
  if (!fault.empty()) return failed<TrackedPose>(fault);
  Parsed<TrackedPose> parsed;
  parsed.stamp = header.stamp;
  parsed.value = {{rotation.normalized().toRotationMatrix(), position_unit * position}, withoutSlash(header.frame_id), ""};
  return parsed;
}

}  // namespace

Parsed<Pressures> readPressures(const topic_tools::ShapeShifter& message, const PressureFormat& format) {
  Parsed<Pressures> pressures = readArray<ChamberPressures>(message);
  for (int k = 0; k < pressures.value.size() && pressures.ok(); ++k) {
    const std::string error = pressureError(pressures.value[k], format);
    if (!error.empty()) pressures.error = "pressure of channel " + std::to_string(k + 1) + " " + error;
    pressures.value[k] = format.gauge(pressures.value[k]);
  }
  return pressures;
}

Parsed<Eigen::VectorXd> readRodLengths(const topic_tools::ShapeShifter& message, double unit) {
  Parsed<Eigen::VectorXd> lengths = readArray<RodLengths>(message);
  for (int i = 0; i < lengths.value.size() && lengths.ok(); ++i)
    if (!std::isfinite(lengths.value[i]))
      lengths.error =
          "length of rod " + std::to_string(i + 1) + " is " + numberText(lengths.value[i]) + ": must be finite";
  lengths.value *= unit;
  return lengths;
}

Parsed<double> readPressure(const sensor_msgs::FluidPressure& message, const PressureFormat& format) {
  Parsed<double> parsed;
  parsed.stamp = message.header.stamp;
  parsed.value = format.gauge(message.fluid_pressure);
  const std::string error = pressureError(message.fluid_pressure, format);
  if (!error.empty()) parsed.error = "pressure " + error;
  return parsed;
}

Parsed<TrackedPose> readPose(const topic_tools::ShapeShifter& message, double position_unit) {
  const std::string& type = message.getDataType();
  if (type == "geometry_msgs/PoseStamped") {
    if (const auto typed = decode<geometry_msgs::PoseStamped>(message))
      return checkedPose(typed->header, typed->pose.position, typed->pose.orientation, position_unit);
  } else if (type == "geometry_msgs/PoseWithCovarianceStamped") {
    if (const auto typed = decode<geometry_msgs::PoseWithCovarianceStamped>(message))
      return checkedPose(typed->header, typed->pose.pose.position, typed->pose.pose.orientation, position_unit);
  } else if (type == "geometry_msgs/TransformStamped") {
    if (const auto typed = decode<geometry_msgs::TransformStamped>(message)) return readPose(*typed, position_unit);
  } else {
    return failed<TrackedPose>("message type " + type + ": must be geometry_msgs/PoseStamped, "
                               "geometry_msgs/PoseWithCovarianceStamped or geometry_msgs/TransformStamped");
  }
  return failed<TrackedPose>(damaged(message));
}

Parsed<TrackedPose> readPose(const geometry_msgs::TransformStamped& message, double position_unit) {
  Parsed<TrackedPose> parsed =
      checkedPose(message.header, message.transform.translation, message.transform.rotation, position_unit);
  parsed.value.child = withoutSlash(message.child_frame_id);
  return parsed;
}

Parsed<Pose> readPose(const geometry_msgs::Pose& message) {
  const Parsed<TrackedPose> checked = checkedPose({}, message.position, message.orientation, 1.0);
  if (!checked.ok()) return failed<Pose>("pose must be finite, with a quaternion of length 1");
  return {checked.stamp, checked.value.pose, ""};
}

Parsed<Matrix3> readAxes(const std::string& frame, const FrameNames& frames, const Pose* X_BT) {
  const std::string name = withoutSlash(frame);
  if (name.empty() || name == frames.base) return {ros::Time(), Matrix3::Identity(), ""};
  if (name != frames.body)
    return failed<Matrix3>("unknown frame " + name + ": must be " + frames.base +
                           (frames.body.empty() ? "" : " or " + frames.body));
  if (X_BT == nullptr) return failed<Matrix3>("the axes of " + name + " are not known before the first estimate");
  return {ros::Time(), X_BT->R, ""};
}

Parsed<Wrench> readWrench(const geometry_msgs::WrenchStamped& message, const FrameNames& frames, const Pose* X_BT) {
  Parsed<Wrench> parsed;
  parsed.stamp = message.header.stamp;
  parsed.value << fromXyz(message.wrench.force), fromXyz(message.wrench.torque);
  if (!parsed.value.allFinite()) return failed<Wrench>("wrench is not finite: six finite numbers, N and N m");
  const Parsed<Matrix3> axes = readAxes(message.header.frame_id, frames, X_BT);
  parsed.error = axes.error;
  if (axes.ok()) parsed.value = wrenchAdjoint({axes.value, Vector3::Zero()}) * parsed.value;
  return parsed;
}

Parsed<Vector3> readVector(const geometry_msgs::Vector3& message, const std::string& name) {
  const Vector3 value = fromXyz(message);
  if (!value.allFinite())
    return failed<Vector3>(name + " = [" + numberText(value.x()) + ", " + numberText(value.y()) + ", " +
                           numberText(value.z()) + "]: must be three finite numbers");
  return {ros::Time(), value, ""};
}

}  // namespace live_stiffness
