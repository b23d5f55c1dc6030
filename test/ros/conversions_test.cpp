#include "ros/conversions.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <live_stiffness/RodLengths.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/Float64.h>

#include <limits>
#include <vector>


namespace live_stiffness {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A message as it arrives from the network.
template <class Message>
topic_tools::ShapeShifter onTheWire(const Message& message) {
  std::vector<uint8_t> buffer(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(buffer.data(), buffer.size());
  ros::serialization::serialize(out, message);
  topic_tools::ShapeShifter shape;
  shape.morph(ros::message_traits::MD5Sum<Message>::value(), ros::message_traits::DataType<Message>::value(),
              ros::message_traits::Definition<Message>::value(), "");
  ros::serialization::IStream in(buffer.data(), buffer.size());
  shape.read(in);
  return shape;
}

Pose somePose() { return {expSo3(Vector3(0.4, -1.1, 0.7)), Vector3(0.01, -0.02, 0.05)}; }

TEST(Conversions, PressuresGoThereAndBack) {
  Pressures pressures(3);
  pressures << 1.5e5, -2e4, 0.125;
  const auto reading = readPressures(onTheWire(toPressures(pressures, ros::Time(12.5))), PressureFormat());
  ASSERT_TRUE(reading.ok()) << reading.error;
  EXPECT_EQ(reading.value, pressures);
  EXPECT_EQ(reading.stamp, ros::Time(12.5));
}

TEST(Conversions, ArraysAreReadInTheirUnitAndReference) {
  std_msgs::Float64MultiArray doubles;
  doubles.data = {101.325, 151.325};
  PressureFormat absolute_kpa;
  absolute_kpa.unit = "kPa";
  absolute_kpa.reference = "absolute";
  auto reading = readPressures(onTheWire(doubles), absolute_kpa);
  ASSERT_TRUE(reading.ok());
  EXPECT_NEAR(reading.value[0], 0.0, 1e-9);
  EXPECT_NEAR(reading.value[1], 50e3, 1e-9);
  EXPECT_TRUE(reading.stamp.isZero());
  std_msgs::Float32MultiArray floats;
  floats.data = {1.0f, 0.5f};
  PressureFormat bar;
  bar.unit = "bar";
  reading = readPressures(onTheWire(floats), bar);
  ASSERT_TRUE(reading.ok());
  EXPECT_EQ(reading.value[1], 0.5e5);
}

TEST(Conversions, UnitsOfPressure) {
  EXPECT_EQ(pascalsPerUnit("Pa"), 1.0);
  EXPECT_EQ(pascalsPerUnit("kPa"), 1e3);
  EXPECT_EQ(pascalsPerUnit("bar"), 1e5);
  EXPECT_EQ(pascalsPerUnit("mbar"), 1e2);
  EXPECT_NEAR(pascalsPerUnit("psi"), 4.4482216152605 / (0.0254 * 0.0254), 1e-6);  // lbf / in^2
  EXPECT_EQ(pascalsPerUnit("atm"), 0.0);
}

TEST(Conversions, BadPressuresAreErrorsThatNameTheChannel) {
  std_msgs::Float64MultiArray message;
  message.data = {0.0, kNaN};
  EXPECT_NE(readPressures(onTheWire(message), PressureFormat()).error.find("channel 2"), std::string::npos);
  message.data = {-5.0, 1.0};
  PressureFormat absolute;
  absolute.reference = "absolute";
  EXPECT_NE(readPressures(onTheWire(message), absolute).error.find("negative"), std::string::npos);
  EXPECT_TRUE(readPressures(onTheWire(message), PressureFormat()).ok()) << "a gauge pressure may be negative";
  message.data[0] = 3e38;
  EXPECT_NE(readPressures(onTheWire(message), PressureFormat()).error.find("1e+08"), std::string::npos);
  EXPECT_NE(readPressures(onTheWire(std_msgs::Float64()), PressureFormat()).error.find("std_msgs/Float64:"),
            std::string::npos);
}

// A message of the type that says it is, with these bytes.
template <class Message>
topic_tools::ShapeShifter withBytes(std::vector<uint8_t> bytes, const std::string& md5 = "") {
  topic_tools::ShapeShifter shape;
  shape.morph(md5.empty() ? ros::message_traits::MD5Sum<Message>::value() : md5,
              ros::message_traits::DataType<Message>::value(), ros::message_traits::Definition<Message>::value(), "");
  ros::serialization::IStream in(bytes.data(), bytes.size());
  if (!bytes.empty()) shape.read(in);  // of nothing, topic_tools copies zero bytes to a null pointer
  return shape;
}

TEST(Conversions, MessagesCutShortAreErrors) {
  EXPECT_NE(readPressures(withBytes<ChamberPressures>({1, 2, 3}), PressureFormat()).error.find("damaged"),
            std::string::npos);
  EXPECT_FALSE(readRodLengths(withBytes<RodLengths>({}), 1.0).ok());
  EXPECT_FALSE(readPose(withBytes<geometry_msgs::PoseStamped>({1, 2, 3}), 1.0).ok());
  EXPECT_FALSE(readPose(withBytes<geometry_msgs::PoseWithCovarianceStamped>({}), 1.0).ok());
  EXPECT_FALSE(readPose(withBytes<geometry_msgs::TransformStamped>({}), 1.0).ok());
}

TEST(Conversions, MessagesThatClaimFourThousandMillionNumbersAreErrors) {
  // Sequence, stamp, empty frame, then the length of the array; the dimensions of a MultiArray come first.
  std::vector<uint8_t> stamped(16, 0), dimensions;
  for (auto* bytes : {&stamped, &dimensions}) bytes->insert(bytes->end(), 4, 0xff);
  EXPECT_FALSE(readPressures(withBytes<ChamberPressures>(stamped), PressureFormat()).ok());
  EXPECT_FALSE(readRodLengths(withBytes<RodLengths>(stamped), 1.0).ok());
  EXPECT_FALSE(readPressures(withBytes<std_msgs::Float64MultiArray>(dimensions), PressureFormat()).ok());
  EXPECT_FALSE(readPressures(withBytes<std_msgs::Float32MultiArray>(dimensions), PressureFormat()).ok());
}

TEST(Conversions, AnotherVersionOfTheTypeIsAnError) {
  const auto message = withBytes<ChamberPressures>({}, "0123456789abcdef0123456789abcdef");
  EXPECT_NE(readPressures(message, PressureFormat()).error.find("version of live_stiffness/ChamberPressures"),
            std::string::npos);
}

TEST(Conversions, PoseGoesThereAndBackThroughAllThreeTypes) {
  const Pose X = somePose();
  const auto stamped = toPoseStamped(X, ros::Time(3.0), "/aurora");
  geometry_msgs::PoseWithCovarianceStamped covariance;
  covariance.header = stamped.header;
  covariance.pose.pose = stamped.pose;
  const auto transform = toTransform(X, ros::Time(3.0), "/aurora", "tip");
  for (const auto& reading : {readPose(onTheWire(stamped), 1.0), readPose(onTheWire(covariance), 1.0),
                              readPose(onTheWire(transform), 1.0)}) {
    ASSERT_TRUE(reading.ok()) << reading.error;
    EXPECT_LT((reading.value.pose.R - X.R).norm(), 1e-15);
    EXPECT_EQ(reading.value.pose.p, X.p);
    EXPECT_EQ(reading.value.frame, "aurora");
    EXPECT_EQ(reading.stamp, ros::Time(3.0));
  }
  EXPECT_NEAR(readPose(onTheWire(stamped), 1e-3).value.pose.p.z(), 50e-6, 1e-18) << "millimetres";
}

TEST(Conversions, UnusablePosesAreErrors) {
  auto zero = toPoseStamped(somePose(), ros::Time(1.0), "aurora"), far = zero, not_finite = zero;
  zero.pose.orientation.w = zero.pose.orientation.x = zero.pose.orientation.y = zero.pose.orientation.z = 0.0;
  far.pose.orientation.w += 1.0;
  not_finite.pose.position.y = kNaN;
  for (const auto& pose : {zero, far, not_finite}) EXPECT_FALSE(readPose(onTheWire(pose), 1.0).ok());
  EXPECT_FALSE(readPose(onTheWire(std_msgs::Float64()), 1.0).ok());
  auto flipped = toPoseStamped(somePose(), ros::Time(1.0), "aurora");
  auto& q = flipped.pose.orientation;
  q.w = -q.w, q.x = -q.x, q.y = -q.y, q.z = -q.z;
  EXPECT_LT((readPose(onTheWire(flipped), 1.0).value.pose.R - somePose().R).norm(), 1e-15) << "sign has no meaning";
}

TEST(Conversions, MatricesAreRowByRowLinearFirst) {
  Estimate estimate;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) estimate.solution.compliance(i, j) = 10 * i + j;
  estimate.pressures = Pressures::Constant(2, 5.0);
  const StiffnessEstimate message = toEstimate(estimate, ros::Time(1.0), "base");
  EXPECT_EQ(message.compliance[1], 1.0);
  EXPECT_EQ(message.compliance[6], 10.0);
  EXPECT_EQ(message.compliance[35], 55.0);
  EXPECT_EQ(message.pressure.size(), 2u);
}

TEST(Conversions, TrackingErrorIsMeasuredMinusPredicted) {
  const Pose predicted = somePose();
  Pose measured = predicted;
  measured.p += Vector3(0.003, 0.0, -0.004);
  measured.R = expSo3(Vector3(0.0, 0.02, 0.0)) * predicted.R;
  const TrackingError error = toTrackingError(measured, predicted, residualTwist(measured, predicted), ros::Time(1.0), "base");
  EXPECT_NEAR(error.distance, 0.005, 1e-15);
  EXPECT_NEAR(error.angle, 0.02, 1e-14);
  EXPECT_NEAR(error.rotation.y, 0.02, 1e-14);
  EXPECT_NEAR(error.translation.z, -0.004, 1e-15);
}

TEST(Conversions, RodLengthsAreReadInTheirUnit) {
  RodLengths stamped;
  stamped.header.stamp = ros::Time(2.0);
  stamped.length = {400.0, 410.0};
  std_msgs::Float64MultiArray bare;
  bare.data = stamped.length;
  for (const auto& reading : {readRodLengths(onTheWire(stamped), 1e-3), readRodLengths(onTheWire(bare), 1e-3)}) {
    ASSERT_TRUE(reading.ok()) << reading.error;
    ASSERT_EQ(reading.value.size(), 2);
    EXPECT_NEAR(reading.value[1], 0.41, 1e-15);
  }
  bare.data[1] = kNaN;
  EXPECT_NE(readRodLengths(onTheWire(bare), 1.0).error.find("rod 2"), std::string::npos);
  EXPECT_NE(readRodLengths(onTheWire(std_msgs::Float64()), 1.0).error.find("live_stiffness/RodLengths"),
            std::string::npos);
}

TEST(Conversions, WrenchIsTurnedFromTheAxesOfItsFrameToBaseAxes) {
  const FrameNames frames{"base", "tip"};
  const Pose X_BT = somePose();
  Wrench wrench;
  wrench << 1.0, -2.0, 3.0, 0.1, 0.2, -0.3;
  const auto in_base = readWrench(toWrenchStamped(wrench, ros::Time(1.0), "/base"), frames, nullptr);
  ASSERT_TRUE(in_base.ok()) << in_base.error;
  EXPECT_EQ(in_base.value, wrench);
  const auto in_tip = readWrench(toWrenchStamped(wrench, ros::Time(1.0), "tip"), frames, &X_BT);
  ASSERT_TRUE(in_tip.ok()) << in_tip.error;
  EXPECT_LT((linear(in_tip.value) - X_BT.R * linear(wrench)).norm(), 1e-15);
  EXPECT_LT((angular(in_tip.value) - X_BT.R * angular(wrench)).norm(), 1e-15);
  EXPECT_NE(readWrench(toWrenchStamped(wrench, ros::Time(1.0), "tip"), frames, nullptr).error.find("not known"),
            std::string::npos);
  EXPECT_NE(readWrench(toWrenchStamped(wrench, ros::Time(1.0), "camera"), frames, &X_BT).error.find("camera"),
            std::string::npos);
  wrench[4] = kNaN;
  EXPECT_FALSE(readWrench(toWrenchStamped(wrench, ros::Time(1.0), "base"), frames, nullptr).ok());
}

TEST(Conversions, StatusTellsBadInputFromSilence) {
  StiffnessEstimate message;
  setStatus(SolveCode::kOk, "", false, 0.5, "pressures", message);
  EXPECT_FALSE(message.stale);
  EXPECT_TRUE(message.message.empty());
  setStatus(SolveCode::kOk, "", true, 0.5, "pressures", message);
  EXPECT_TRUE(message.stale);
  EXPECT_EQ(message.message, "no pressures for more than 0.5 s");
  setStatus(SolveCode::kOk, "5 channels: must be 6", false, 0.5, "pressures", message);
  EXPECT_EQ(message.status, StiffnessEstimate::INVALID_INPUT);
  setStatus(SolveCode::kUnstable, "would topple", true, 0.5, "pressures", message);
  EXPECT_EQ(message.status, StiffnessEstimate::UNSTABLE);
  EXPECT_EQ(message.message, "would topple");
}

}  // namespace
}  // namespace live_stiffness
