// Messages as they come over the network, of every type that is read: a reading that is finite, or a fault. The first byte
// chooses the type, the rest is the message.

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <live_stiffness/RodLengths.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Float64MultiArray.h>

#include "fuzz_target.h"
#include "ros/conversions.h"

using namespace live_stiffness;

namespace {

template <class Message>
topic_tools::ShapeShifter onTheWire(const std::uint8_t* data, size_t size) {
  topic_tools::ShapeShifter shape;
  shape.morph(ros::message_traits::MD5Sum<Message>::value(), ros::message_traits::DataType<Message>::value(),
              ros::message_traits::Definition<Message>::value(), "");
  ros::serialization::IStream in(const_cast<std::uint8_t*>(data), size);
  if (size > 0) shape.read(in);  // of nothing, topic_tools copies zero bytes to a null pointer; unread is empty, too
  return shape;
}

void checkArrays(const topic_tools::ShapeShifter& message) {
  for (const bool absolute : {false, true}) {
    PressureFormat format;
    format.reference = absolute ? "absolute" : "gauge";
    const Parsed<Pressures> pressures = readPressures(message, format);
    require(!pressures.ok() || pressures.value.allFinite(), "pressures are finite");
  }
  const Parsed<Eigen::VectorXd> lengths = readRodLengths(message, 1e-3);
  require(!lengths.ok() || lengths.value.allFinite(), "lengths are finite");
}

void checkPose(const topic_tools::ShapeShifter& message) {
  const Parsed<TrackedPose> reading = readPose(message, 1e-3);
  if (!reading.ok()) return;
  const Pose& X = reading.value.pose;
  require(X.p.allFinite(), "positions are finite");
  // Rounding of a normalised quaternion: a few 1e-16.
  require((X.R * X.R.transpose() - Matrix3::Identity()).norm() < 1e-12, "rotations are rotations");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::uint8_t* const message = data + 1;
  switch (data[0] % 7) {
    case 0: checkArrays(onTheWire<ChamberPressures>(message, size - 1)); break;
    case 1: checkArrays(onTheWire<RodLengths>(message, size - 1)); break;
    case 2: checkArrays(onTheWire<std_msgs::Float64MultiArray>(message, size - 1)); break;
    case 3: checkArrays(onTheWire<std_msgs::Float32MultiArray>(message, size - 1)); break;
    case 4: checkPose(onTheWire<geometry_msgs::PoseStamped>(message, size - 1)); break;
    case 5: checkPose(onTheWire<geometry_msgs::PoseWithCovarianceStamped>(message, size - 1)); break;
    case 6: checkPose(onTheWire<geometry_msgs::TransformStamped>(message, size - 1)); break;
  }
  return 0;
}
