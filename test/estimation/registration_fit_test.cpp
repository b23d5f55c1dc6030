#include "live_stiffness/estimation/registration_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

// Tip of a robot that bends as an arc of 50 mm towards an azimuth (rad) by an angle (rad).
Pose bent(double azimuth, double angle) {
  return expSe3(Vector3::UnitZ(), angle / 0.05 * Vector3(-std::sin(azimuth), std::cos(azimuth), 0.0), 0.05);
}

// Bends of up to 60 deg towards `sides` sides, evenly around.
std::vector<Pose> bends(int sides) {
  std::vector<Pose> X_BT;
  for (int side = 0; side < sides; ++side)
    for (int k = 0; k <= 20; ++k) X_BT.push_back(bent(0.4 + 2.0 * kPi * side / sides, k / 20.0 * radians(60.0)));
  return X_BT;
}

Registration someRegistration(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto vector = [&](double scale) {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vector3(scale * Vector3(x, y, z));
  };
  Registration registration;
  registration.X_AB = {expSo3(vector(2.0)), vector(0.3)};
  registration.X_TS = {expSo3(vector(2.0)), vector(0.01)};
  return registration;
}

std::vector<Pose> measured(const Registration& registration, const std::vector<Pose>& X_BT) {
  std::vector<Pose> X_AS;
  for (const Pose& X : X_BT) X_AS.push_back(registration.sensorPose(X));
  return X_AS;
}

TEST(RegistrationFit, FindsAnyRegistrationExactlyWithoutNoise) {
  std::mt19937_64 random(7);
  const std::vector<Pose> X_BT = bends(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Registration truth = someRegistration(random);
    const RegistrationFit fit = fitRegistration(X_BT, measured(truth, X_BT));
    // Rounding over the weakest sensitivity, some 0.05, squared in the normal matrix.
    EXPECT_LT((fit.registration.X_AB.R - truth.X_AB.R).norm(), 1e-9) << trial;
    EXPECT_LT((fit.registration.X_AB.p - truth.X_AB.p).norm(), 1e-9) << trial;
    EXPECT_LT((fit.registration.X_TS.R - truth.X_TS.R).norm(), 1e-9) << trial;
    EXPECT_LT((fit.registration.X_TS.p - truth.X_TS.p).norm(), 1e-9) << trial;
    EXPECT_LT(fit.position.max, 1e-9);
    EXPECT_LT(fit.rotation.max, 1e-7);  // angle of a rotation matrix that is unit to 1e-15
    EXPECT_TRUE(fit.determined()) << fit.advice();
  }
}

TEST(RegistrationFit, ResidualsAreTheTrackersNoise) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal(0.0, 0.5e-3);
  std::vector<Pose> X_BT;
  for (int repeat = 0; repeat < 10; ++repeat)
    for (const Pose& X : bends(3)) X_BT.push_back(X);
  const Registration truth = someRegistration(random);
  std::vector<Pose> X_AS = measured(truth, X_BT);
  for (Pose& X : X_AS)
    for (int k = 0; k < 3; ++k) X.p[k] += normal(random);
  const RegistrationFit fit = fitRegistration(X_BT, X_AS);
  const double expected = 0.5e-3 * std::sqrt(3.0);
  // Standard error of an RMS of 3 * 630 numbers is 1.6 %; 9 fitted parameters take 0.2 %. Four times that.
  EXPECT_NEAR(fit.position.rms, expected, 0.07 * expected);
  // Noise over sensitivity and the root of the number of samples is 0.3 to 0.5 mm; four times that.
  EXPECT_LT((fit.registration.X_TS.p - truth.X_TS.p).norm(), 2e-3);
}

TEST(RegistrationFit, IsALeastSquaresMinimum) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal(0.0, 1e-3);
  const std::vector<Pose> X_BT = bends(3);
  std::vector<Pose> X_AS = measured(someRegistration(random), X_BT);
  for (Pose& X : X_AS)
    for (int k = 0; k < 3; ++k) X.p[k] += normal(random);
  const RegistrationFit fit = fitRegistration(X_BT, X_AS);
  const auto cost = [&](const Registration& registration) {
    double sum = 0.0;
    for (size_t i = 0; i < X_BT.size(); ++i) sum += (registration.sensorPose(X_BT[i]).p - X_AS[i].p).squaredNorm();
    return sum;
  };
  const double best = cost(fit.registration);
  for (int k = 0; k < 9; ++k) {
    for (double sign : {-1.0, 1.0}) {
      Registration moved = fit.registration;
      if (k < 3) moved.X_AB.R = expSo3(sign * 1e-4 * Vector3::Unit(k)) * moved.X_AB.R;
      else if (k < 6) moved.X_AB.p[k - 3] += sign * 1e-5;
      else moved.X_TS.p[k - 6] += sign * 1e-4;
      EXPECT_GT(cost(moved), best) << k;
    }
  }
}

TEST(RegistrationFit, RobotAtRestLeavesOffsetAndRotationOpen) {
  std::mt19937_64 random(10);
  const std::vector<Pose> X_BT(20, bent(0.0, 0.0));
  const RegistrationFit fit = fitRegistration(X_BT, measured(someRegistration(random), X_BT));
  EXPECT_FALSE(fit.sensor_offset_determined);
  EXPECT_FALSE(fit.base_rotation_determined);
  EXPECT_EQ(fit.registration.X_TS.p, Vector3::Zero());
  EXPECT_LT(fit.position.max, 1e-12);  // the poses still agree where the robot is
  EXPECT_LT(fit.rotation.max, 1e-7);
  EXPECT_NE(fit.advice().find("offset"), std::string::npos);
}

TEST(RegistrationFit, StretchAloneLeavesTheOffsetOpenAtZero) {
  std::vector<Pose> X_BT;
  for (int k = 0; k < 20; ++k) X_BT.push_back({Matrix3::Identity(), Vector3(0.0, 0.0, 0.05 + 1e-3 * k)});
  Registration truth;
  truth.X_AB = {expSo3(Vector3(0.3, 0.2, 0.0)), Vector3(1.0, 2.0, 3.0)};  // no turn about z of B, which is open
  truth.X_TS.p = Vector3(0.01, 0.0, 0.0);
  const RegistrationFit fit = fitRegistration(X_BT, measured(truth, X_BT));
  EXPECT_FALSE(fit.sensor_offset_determined);
  EXPECT_FALSE(fit.base_rotation_determined);
  EXPECT_LT(fit.registration.X_TS.p.norm(), 1e-9);
  EXPECT_LT((fit.registration.X_AB.R.col(2) - truth.X_AB.R.col(2)).norm(), 1e-4);  // the axis is determined
}

TEST(RegistrationFit, BendingInOnePlaneLeavesTheOffsetAcrossItOpen) {
  std::vector<Pose> X_BT;
  for (int k = -20; k <= 20; ++k) X_BT.push_back(bent(0.0, k / 20.0 * radians(60.0)));  // about y of B
  Registration truth;
  truth.X_AB = {expSo3(Vector3(0.3, -0.2, 0.5)), Vector3(1.0, 2.0, 3.0)};
  truth.X_TS.p = Vector3(0.006, 0.008, 0.004);
  const RegistrationFit fit = fitRegistration(X_BT, measured(truth, X_BT));
  EXPECT_FALSE(fit.sensor_offset_determined);
  EXPECT_TRUE(fit.base_rotation_determined);
  // In the plane the offset is found; across it, it stays at zero, and the base takes it up.
  EXPECT_LT((fit.registration.X_TS.p - Vector3(0.006, 0.0, 0.004)).norm(), 1e-6);
  EXPECT_LT(fit.position.max, 1e-6);
}

TEST(RegistrationFit, NoiseDoesNotBlowUpAnOffsetThatIsOpen) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0.0, 0.5e-3);
  std::vector<Pose> X_BT;  // about y of B, and a twitch of 0.1 deg out of the plane that determines nothing
  for (int k = -20; k <= 20; ++k) X_BT.push_back(bent(radians(0.1 * (k % 2)), k / 20.0 * radians(60.0)));
  Registration truth;
  truth.X_TS.p = Vector3(0.006, 0.0, 0.004);
  std::vector<Pose> X_AS = measured(truth, X_BT);
  for (Pose& X : X_AS)
    for (int k = 0; k < 3; ++k) X.p[k] += normal(random);
  const RegistrationFit fit = fitRegistration(X_BT, X_AS);
  EXPECT_FALSE(fit.sensor_offset_determined);
  // Sensitivity to the twitch is 1e-3, so a fit of it would answer 0.5 mm of noise with some 80 mm.
  EXPECT_LT(std::abs(fit.registration.X_TS.p.y()), 2e-3);
}

TEST(RegistrationFit, FindsTheBaseFromPositionsAlone) {
  std::mt19937_64 random(12);
  const std::vector<Pose> X_BT = bends(3);
  for (int trial = 0; trial < 50; ++trial) {
    Registration truth = someRegistration(random);
    truth.X_TS.p *= 0.3;  // some 5 mm; without orientations the start must come near by itself
    std::vector<Pose> X_AS = measured(truth, X_BT);
    for (Pose& X : X_AS) X.R.setIdentity();  // a tracker that reports no orientation
    const RegistrationFit fit = fitRegistration(X_BT, X_AS);
    EXPECT_LT((fit.registration.X_AB.R - truth.X_AB.R).norm(), 1e-9) << trial;
    EXPECT_LT((fit.registration.X_TS.p - truth.X_TS.p).norm(), 1e-9) << trial;
  }
}

TEST(RegistrationFit, UsesOfOrientationsWhatIsMeasured) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(-kPi, kPi);
  const std::vector<Pose> X_BT = bends(3);
  Registration truth = someRegistration(random);
  truth.X_TS.p *= 0.3;
  std::vector<Pose> X_AS = measured(truth, X_BT);
  for (Pose& X : X_AS) X.R *= expSo3(uniform(random) * Vector3::UnitZ());  // a coil with five degrees of freedom
  for (const auto& measures : {std::optional<TrackerMeasures>(), std::optional(TrackerMeasures::kPositionAndAxis)}) {
    const RegistrationFit fit = fitRegistration(X_BT, X_AS, measures);
    EXPECT_EQ(fit.measures, TrackerMeasures::kPositionAndAxis);
    EXPECT_TRUE(fit.determined()) << fit.advice();
    EXPECT_LT((fit.registration.X_AB.R - truth.X_AB.R).norm(), 1e-9);
    EXPECT_LT((fit.registration.X_TS.R.col(2) - truth.X_TS.R.col(2)).norm(), 1e-9);
    EXPECT_LT(fit.rotation.max, 1e-7);
    EXPECT_NE(fit.unmeasured().find("about its z axis"), std::string::npos);
  }
  const RegistrationFit position = fitRegistration(X_BT, X_AS, TrackerMeasures::kPosition);
  EXPECT_TRUE(position.determined()) << position.advice();
  EXPECT_LT((position.registration.X_TS.p - truth.X_TS.p).norm(), 1e-9);
  EXPECT_EQ(position.registration.X_TS.R, Matrix3::Identity());
  EXPECT_EQ(position.rotation.count, 0);
}

TEST(RegistrationFit, MisreadOrientationsAreNotDeterminedAndNamed) {
  std::mt19937_64 random(14);
  const std::vector<Pose> X_BT = bends(3);
  std::vector<Pose> X_AS = measured(someRegistration(random), X_BT);
  for (Pose& X : X_AS) {
    const Eigen::Quaterniond q(X.R);
    X.R = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
  }
  const RegistrationFit fit = fitRegistration(X_BT, X_AS);
  EXPECT_FALSE(fit.determined());
  EXPECT_NE(fit.advice().find("fit when read as x, y, z, w: 0.0 deg instead of"), std::string::npos) << fit.advice();
}

TEST(RegistrationFit, RefusesUnusableSamplesWithAllFaults) {
  std::vector<Pose> X_BT(2), X_AS(3);
  X_AS[1].p.x() = std::nan("");
  try {
    fitRegistration(X_BT, X_AS);
    FAIL() << "accepted";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.faults().size(), 3u) << error.what();
  }
}

}  // namespace
}  // namespace live_stiffness
