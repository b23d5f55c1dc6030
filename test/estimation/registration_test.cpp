#include "live_stiffness/estimation/registration.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

#include "live_stiffness/checks.h"
#include "support/decimal_comma.h"

namespace live_stiffness {
namespace {

const char* const kGood =
    "base_in_tracker: {position_m: [1, 2, 3], quaternion_wxyz: [1, 0, 0, 0]}\n"
    "sensor_on_tip: {position_m: [0, 0, 0.01], quaternion_wxyz: [0, 0, 3, 0]}\n";

Registration example() {
  Registration registration;
  registration.X_AB = {expSo3(Vector3(0.3, -2.0, 1.0)), Vector3(0.1, -0.2, 1.0 / 3.0)};
  registration.X_TS = {expSo3(Vector3(-0.7, 0.1, 0.4)), Vector3(0.012, -0.003, 0.002)};
  return registration;
}

void expectSame(const Pose& a, const Pose& b) {
  EXPECT_LT((a.R - b.R).norm(), 1e-14);  // through a quaternion of 17 digits
  EXPECT_EQ(a.p, b.p);
}

std::vector<std::string> faultsOf(const std::string& yaml) {
  try {
    parseRegistration(yaml, "test");
  } catch (const ConfigurationError& error) {
    return error.faults();
  }
  return {};
}

TEST(Registration, TipPoseUndoesSensorPose) {
  const Pose X_BT{expSo3(Vector3(0.5, 0.2, -0.1)), Vector3(0.01, 0.02, 0.05)};
  const Pose back = example().tipPose(example().sensorPose(X_BT));
  EXPECT_LT((back.p - X_BT.p).norm(), 1e-15);
  EXPECT_LT((back.R - X_BT.R).norm(), 1e-14);
}

TEST(Registration, TextReadsBack) {
  const Registration back = parseRegistration(registrationText(example(), "two\nlines: of comment"), "test");
  expectSame(back.X_AB, example().X_AB);
  expectSame(back.X_TS, example().X_TS);
}

TEST(Registration, DelayOfTheTrackerReadsBackAndIsZeroWhereItIsLeftOut) {
  Registration late = example();
  late.tracker_delay = 0.1503;
  EXPECT_EQ(parseRegistration(registrationText(late), "test").tracker_delay, 0.1503);
  EXPECT_EQ(parseRegistration(kGood, "test").tracker_delay, 0.0);
  ASSERT_EQ(faultsOf(std::string(kGood) + "tracker_delay_s: 3\n").size(), 1u);
  EXPECT_NE(faultsOf(std::string(kGood) + "tracker_delay_s: 3\n")[0].find(">= -1 and <= 1"), std::string::npos);
}

TEST(Registration, FileReadsBack) {
  const std::string path = testing::TempDir() + "registration_test_" + std::to_string(getpid()) + ".yaml";
  saveRegistrationFile(path, example());
  const Registration back = loadRegistrationFile(path);
  std::remove(path.c_str());
  expectSame(back.X_AB, example().X_AB);
  expectSame(back.X_TS, example().X_TS);
}

TEST(Registration, QuaternionsAreNormalised) {
  const Registration registration = parseRegistration(kGood, "test");
  EXPECT_EQ(registration.X_TS.R, Matrix3(Vector3(-1.0, 1.0, -1.0).asDiagonal()));
  EXPECT_EQ(registration.X_AB.p, Vector3(1.0, 2.0, 3.0));
}

TEST(Registration, ReportsAllFaultsAtOnce) {
  const std::vector<std::string> faults = faultsOf(
      "base_in_tracker: {position_m: [1, 2], quaternion_wxyz: [0, 0, 0, 0], scale: 2}\n"
      "sensor_on_tip: {position_m: [1, .nan, 3]}\n"
      "extra: 1\n");
  EXPECT_EQ(faults.size(), 6u) << ConfigurationError("got", faults).what();
  EXPECT_EQ(faultsOf("{}").size(), 2u);
  EXPECT_EQ(faultsOf("[1, 2").size(), 1u);
}

TEST(Registration, ReadsAndWritesTheSameWhateverTheLocaleOfTheProcess) {
  const std::string text = registrationText(parseRegistration(kGood, "test"), "");
  const DecimalComma comma;
  EXPECT_EQ(registrationText(parseRegistration(kGood, "test"), ""), text);
}

TEST(Registration, TakesMergeKeys) {
  const Registration registration = parseRegistration(
      "upright: &upright {quaternion_wxyz: [1, 0, 0, 0], position_m: [0, 0, 0]}\n"
      "base_in_tracker: {<<: *upright, position_m: [0.1, 0.2, 0.3]}\nsensor_on_tip: *upright\n", "test");
  EXPECT_EQ(registration.X_AB.p, Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(registration.X_TS.p, Vector3(0.0, 0.0, 0.0));
}

TEST(Registration, ZeroQuaternionIsNamed) {
  std::string yaml = kGood;
  yaml.replace(yaml.find("[1, 0, 0, 0]"), 12, "[0, 0, 0, 0]");
  const std::vector<std::string> faults = faultsOf(yaml);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("base_in_tracker.quaternion_wxyz"), std::string::npos) << faults[0];
}

// The norm of such a one overflows, and dividing by it would leave the identity without a word.
TEST(Registration, HugeQuaternionIsRefused) {
  std::string yaml = kGood;
  yaml.replace(yaml.find("[1, 0, 0, 0]"), 12, "[0, 1e200, 0, 0]");
  EXPECT_EQ(faultsOf(yaml).size(), 1u);
}

TEST(Registration, UnreachableFilesAreRefused) {
  EXPECT_THROW(loadRegistrationFile("/nowhere/registration.yaml"), ConfigurationError);
  EXPECT_THROW(saveRegistrationFile("/nowhere/registration.yaml", {}), ConfigurationError);
}

}  // namespace
}  // namespace live_stiffness
