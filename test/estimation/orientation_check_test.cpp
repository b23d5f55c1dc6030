#include "estimation/orientation_check.h"

#include <gtest/gtest.h>

#include <random>

#include "live_stiffness/estimation/registration.h"

namespace live_stiffness {
namespace {

using Order = PoseReading::Order;

// A robot of constant curvature that bends towards three sides, seen by a tracker with noise. The model bends too much or too
// little by up to `model_error`, relative, and the robot has errors of its own that last for some samples.
class Simulated {
 public:
  // along_y: the axis of the robot is the y axis of the tracker.
  Simulated(unsigned seed, double model_error, bool along_y = false) : random_(seed) {
    registration_.X_AB = {expSo3(vector(2.0)), vector(0.3)};
    if (along_y) registration_.X_AB.R = expSo3(-kPi / 2.0 * Vector3::UnitX());
    registration_.X_TS = {expSo3(vector(2.0)), vector(0.008)};
    const double length = uniform(0.04, 0.3), largest = radians(uniform(25.0, 100.0));
    const double gain = uniform(1.0 - model_error, 1.0 + model_error);
    const double lasting_error = uniform(0.0, 0.3 * model_error) * largest;
    const int sides = 3;
    Vector3 lasting = Vector3::Zero();
    for (int side = 0; side < sides; ++side) {
      const double azimuth = side * 2.0 * kPi / sides + uniform(-0.4, 0.4);
      for (int k = 0; k <= 60; ++k) {
        const Vector3 axis(-std::sin(azimuth), std::cos(azimuth), 0.0);
        const double angle = largest * (1.0 - std::abs(k - 30.0) / 30.0);
        lasting = 0.9 * lasting + 0.4 * vector(lasting_error);
        X_BT.push_back(expSe3(Vector3::UnitZ(), gain * angle / length * axis, length));
        const Pose actual = expSe3(Vector3::UnitZ(), (angle * axis + lasting) / length, length);
        X_AS.push_back(registration_.sensorPose(actual));
        X_AS.back().p += vector(0.3e-3);
        X_AS.back().R *= expSo3(vector(radians(0.3)));
      }
    }
  }

  Vector3 vector(double scale) {
    const double x = normal_(random_), y = normal_(random_), z = normal_(random_);
    return Vector3(scale * x, scale * y, scale * z);
  }
  double uniform(double low, double high) { return low + (high - low) * std::uniform_real_distribution<double>()(random_); }

  std::vector<Pose> X_BT, X_AS;

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Registration registration_;
};

// What a tracker gave that must be read so: the steps of the reading undone, last one first.
std::vector<Pose> spoilt(const PoseReading& reading, std::vector<Pose> poses) {
  PoseReading mirrors, inverse, order;
  mirrors.mirrored_rotation = reading.mirrored_rotation;
  mirrors.mirrored_position = reading.mirrored_position;
  inverse.inverse = reading.inverse;
  if (reading.order != Order::kAsGiven) order.order = reading.order == Order::kXyzw ? Order::kWxyz : Order::kXyzw;
  for (Pose& X : poses) X = apply(order, apply(inverse, apply(mirrors, X)));
  return poses;
}

constexpr int kRobots = 20;

TEST(OrientationCheck, NeverAccusesGoodData) {
  for (unsigned seed = 0; seed < 150; ++seed) {
    const Simulated robot(seed, 0.5);
    const OrientationCheck check = checkOrientations(robot.X_BT, robot.X_AS);
    EXPECT_FALSE(check.wrong()) << seed << ": " << check.text();
    EXPECT_EQ(check.measures, TrackerMeasures::kPose) << seed << ": " << check.text();
  }
}

TEST(OrientationCheck, NamesEachMisreadingAndItsReadingMendsIt) {
  const std::vector<PoseReading> wrongs{{Order::kXyzw},           {Order::kWxyz},          {Order::kAsGiven, true},
                                        {Order::kXyzw, true},     {Order::kWxyz, true},    {Order::kAsGiven, false, 0},
                                        {Order::kAsGiven, false, 1}, {Order::kAsGiven, false, 2}, {Order::kAsGiven, true, 1},
                                        {Order::kAsGiven, false, -1, 0}, {Order::kAsGiven, false, -1, 1},
                                        {Order::kAsGiven, false, -1, 2}, {Order::kAsGiven, false, 1, 1},
                                        {Order::kXyzw, false, -1, 2}, {Order::kAsGiven, true, -1, 0}};
  int unnamed = 0;
  for (const PoseReading& wrong : wrongs) {
    for (unsigned seed = 0; seed < kRobots; ++seed) {
      const Simulated robot(seed, 0.05);
      const std::vector<Pose> X_AS = spoilt(wrong, robot.X_AS);
      const OrientationCheck check = checkOrientations(robot.X_BT, X_AS);
      if (check.readings.empty()) {  // by chance it hardly matters
        ++unnamed;
        EXPECT_LT(check.rotation_as_given, 3.0 * checkOrientations(robot.X_BT, robot.X_AS).rotation_as_given);
        continue;
      }
      ASSERT_EQ(check.readings.size(), 1u) << seed << ", " << wrong.text() << ": " << check.text();
      EXPECT_EQ(check.readings[0].text(), wrong.text()) << seed << ": " << check.text();
      EXPECT_EQ(check.measures, TrackerMeasures::kPose);
      std::vector<Pose> mended = X_AS;
      for (Pose& X : mended) X = apply(check.readings[0], X);
      EXPECT_FALSE(checkOrientations(robot.X_BT, mended).wrong());
      for (size_t i = 0; i < mended.size(); ++i) EXPECT_LT((mended[i].R - robot.X_AS[i].R).norm(), 1e-9);
    }
  }
  EXPECT_LT(unnamed, 10);  // of 300
}

TEST(OrientationCheck, AMotionInOnePlaneAccusesNobody) {
  for (unsigned seed = 0; seed < kRobots; ++seed) {
    const Simulated robot(seed, 0.5);
    const std::vector<Pose> X_BT(robot.X_BT.begin(), robot.X_BT.begin() + 61);
    const std::vector<Pose> X_AS(robot.X_AS.begin(), robot.X_AS.begin() + 61);
    EXPECT_EQ(checkOrientations(X_BT, X_AS).text(), "") << seed;
  }
}

TEST(OrientationCheck, MirroredPositionsAloneAreNamed) {
  const Simulated robot(3, 0.05);
  std::vector<Pose> X_AS = spoilt({Order::kAsGiven, false, -1, 1}, robot.X_AS);
  for (Pose& X : X_AS) X.R.setIdentity();
  for (const auto& measures : {std::optional<TrackerMeasures>(), std::optional(TrackerMeasures::kPosition)}) {
    const OrientationCheck check = checkOrientations(robot.X_BT, X_AS, measures);
    EXPECT_TRUE(check.wrong());
    EXPECT_EQ(check.measures, TrackerMeasures::kPosition);
    EXPECT_NE(check.text().find("y of the positions negated"), std::string::npos) << check.text();
    EXPECT_NE(check.text().find("channels are swapped"), std::string::npos) << check.text();
  }
}

// Orientations stay as they are, and the sensor's offset hides most of what is wrong with the positions.
TEST(OrientationCheck, AMirrorAcrossTheRobotsOwnAxisIsNamed) {
  for (unsigned seed = 0; seed < kRobots; ++seed) {
    const Simulated robot(seed, 0.0, true);
    std::vector<Pose> mirrored = robot.X_AS;
    for (Pose& X : mirrored) X.p.y() = -X.p.y();
    const OrientationCheck check = checkOrientations(robot.X_BT, mirrored);
    EXPECT_TRUE(check.wrong()) << seed << ": " << check.text();
    EXPECT_FALSE(checkOrientations(robot.X_BT, robot.X_AS).wrong()) << seed;
  }
}

TEST(OrientationCheck, FindsWhatIsNotMeasured) {
  for (unsigned seed = 0; seed < kRobots; ++seed) {
    Simulated robot(seed, 0.3);
    const std::vector<Pose> good = robot.X_AS;
    std::vector<Pose> constant = good, random = good, coil = good, no_roll = good;
    for (Pose& X : constant) X.R = good[0].R;
    for (Pose& X : random) X.R = expSo3(robot.vector(3.0));
    for (Pose& X : coil) X.R *= expSo3(robot.uniform(-kPi, kPi) * Vector3::UnitZ());
    for (Pose& X : no_roll) X.R = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), X.R.col(2)).toRotationMatrix();
    const auto found = [&](const std::vector<Pose>& X_AS) {
      const OrientationCheck check = checkOrientations(robot.X_BT, X_AS);
      EXPECT_FALSE(check.wrong()) << seed << ": " << check.text();
      return trackerMeasuresName(check.measures);
    };
    EXPECT_EQ(found(constant), "position") << seed;
    EXPECT_EQ(found(random), "position") << seed;
    EXPECT_EQ(found(coil), "position_and_axis") << seed;
    const OrientationCheck told = checkOrientations(robot.X_BT, constant, TrackerMeasures::kPose);
    EXPECT_TRUE(told.unexplained);
    EXPECT_NE(told.text().find("hardly changes"), std::string::npos) << told.text();
    EXPECT_FALSE(checkOrientations(robot.X_BT, coil, TrackerMeasures::kPositionAndAxis).wrong());
    EXPECT_FALSE(checkOrientations(robot.X_BT, random, TrackerMeasures::kPosition).wrong());
  }
}

}  // namespace
}  // namespace live_stiffness
