#include "live_stiffness/lie/se3.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/matrix_near.h"
#include "support/rotation_samples.h"
#include "support/series_exp.h"

namespace live_stiffness {
namespace {

Eigen::Matrix4d homogeneous(const Pose& X) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = X.R;
  matrix.topRightCorner<3, 1>() = X.p;
  return matrix;
}

Pose randomPose(RandomSource& random) { return {expSo3(random.vector(1.5)), random.vector(0.3)}; }

Matrix6 randomCompliance(RandomSource& random) {
  Matrix6 C;
  for (int i = 0; i < 36; ++i) C(i) = random.uniform(-1.0, 1.0);
  return C;
}

TEST(Pose, ComposesAsHomogeneousMatrices) {
  RandomSource random(21);
  const Pose X = randomPose(random), Y = randomPose(random);
  const Vector3 p = random.vector(1.0);
  EXPECT_TRUE(matrixNear(homogeneous(X * Y), homogeneous(X) * homogeneous(Y), 1e-15));
  EXPECT_TRUE(matrixNear(homogeneous(X.inverse()), homogeneous(X).inverse(), 1e-15));
  EXPECT_TRUE(matrixNear(X * p, (homogeneous(X) * p.homogeneous()).head<3>(), 1e-15));
}

TEST(Pose, ComposedWithItsInverseIsIdentityAndAssociates) {
  RandomSource random(28);
  for (const Vector3& w : sampleRotations(6.25)) {
    const Pose X{expSo3(w), random.vector(0.3)}, Y = randomPose(random), Z = randomPose(random);
    EXPECT_TRUE(matrixNear(homogeneous(X * X.inverse()), Eigen::Matrix4d::Identity(), 4e-15)) << w.transpose();
    EXPECT_TRUE(matrixNear(homogeneous((X * Y) * Z), homogeneous(X * (Y * Z)), 2e-15)) << w.transpose();
    EXPECT_TRUE(matrixNear(homogeneous((X * Y).inverse()), homogeneous(Y.inverse() * X.inverse()), 2e-15));
  }
}

TEST(ExpSe3, EqualsTheMatrixExponential) {  // by its series in long double
  RandomSource random(22);
  for (double bend : sampleAngles(6.25)) {
    const double s = 0.05;
    const Vector3 v = Vector3::UnitZ() + random.vector(0.2), u = random.direction(bend / s);
    Eigen::Matrix4d xi = Eigen::Matrix4d::Zero();
    xi.topLeftCorner<3, 3>() = hat(u);
    xi.topRightCorner<3, 1>() = v;
    // A dozen roundings of numbers of size 1.
    EXPECT_TRUE(matrixNear(homogeneous(expSe3(v, u, s)), seriesExp<4>(s * xi), 2e-15)) << bend;
  }
}

TEST(ExpSe3, BothBranchesAgreeAtTheSameStrainAroundTheSwitch) {
  RandomSource random(29);
  for (double factor : kAroundSwitch) {
    const double s = 0.05;
    const Vector3 v = Vector3::UnitZ() + random.vector(0.2), u = random.direction(factor * kSeriesBelowAngle / s);
    EXPECT_TRUE(matrixNear(homogeneous(expSe3(v, u, s, kForceSeries)), homogeneous(expSe3(v, u, s, kForceClosedForm)),
                           2e-15)) << factor;
  }
}

TEST(ExpSe3, RunsBackwards) {
  RandomSource random(30);
  for (double bend : sampleAngles(6.25)) {
    const Vector3 v = Vector3::UnitZ() + random.vector(0.2), u = random.direction(bend / 0.04);
    const Pose there_and_back = expSe3(v, u, 0.04) * expSe3(v, u, -0.04);
    EXPECT_TRUE(matrixNear(homogeneous(there_and_back), Eigen::Matrix4d::Identity(), 4e-15)) << bend;
  }
}

TEST(ExpSe3, AddsLengthsOfOneStrain) {
  RandomSource random(31);
  for (double bend : sampleAngles(3.1)) {
    const Vector3 v = Vector3::UnitZ() + random.vector(0.2), u = random.direction(bend / 0.04);
    const Pose parts = expSe3(v, u, 0.013) * expSe3(v, u, 0.027);
    EXPECT_TRUE(matrixNear(homogeneous(parts), homogeneous(expSe3(v, u, 0.04)), 2e-15)) << bend;
  }
}

TEST(ExpSe3, PlacesByTheLeftJacobian) {  // p = s V(s u) v, the integral of the tangent
  RandomSource random(32);
  for (double bend : sampleAngles(6.25)) {
    const Vector3 v = Vector3::UnitZ() + random.vector(0.2), u = random.direction(bend / 0.04);
    EXPECT_TRUE(matrixNear(expSe3(v, u, 0.04).p, 0.04 * leftJacobianSo3(0.04 * u) * v, 1e-16)) << bend;
  }
}

TEST(WrenchAdjoint, KeepsPower) {
  RandomSource random(23);
  const Pose X_AB = randomPose(random);
  const Wrench F_B = random.wrench(1.0, 1.0);
  const Twist V_B = random.wrench(1.0, 1.0);
  Twist V_A;  // of the same body, at the origin of A
  angular(V_A) = X_AB.R * angular(V_B);
  linear(V_A) = X_AB.R * linear(V_B) + X_AB.p.cross(angular(V_A));
  EXPECT_NEAR((wrenchAdjoint(X_AB) * F_B).dot(V_A), F_B.dot(V_B), 2e-15);
}

TEST(WrenchAdjoint, OfAProductIsTheProductAndOfTheInverseTheInverse) {  // (48)
  RandomSource random(24);
  for (const Vector3& w : sampleRotations(6.25)) {
    const Pose X{expSo3(w), random.vector(0.3)}, Y = randomPose(random);
    EXPECT_TRUE(matrixNear(wrenchAdjoint(X * Y), wrenchAdjoint(X) * wrenchAdjoint(Y), 2e-15)) << w.transpose();
    EXPECT_TRUE(matrixNear(wrenchAdjoint(X) * wrenchAdjoint(X.inverse()), Matrix6::Identity(), 4e-15))
        << w.transpose();
  }
}

TEST(WrenchAdjoint, TurnedByDeltaIsItsInverseTransposed) {  // (50): Delta Ad Delta = Ad^-T, which takes twists
  RandomSource random(33);
  Matrix6 delta = Matrix6::Zero();
  delta.topRightCorner<3, 3>().setIdentity();
  delta.bottomLeftCorner<3, 3>().setIdentity();
  for (const Vector3& w : sampleRotations(6.25)) {
    const Pose X{expSo3(w), random.vector(0.3)};
    EXPECT_TRUE(matrixNear(delta * wrenchAdjoint(X) * delta, wrenchAdjoint(X.inverse()).transpose(), 1e-15))
        << w.transpose();
  }
}

TEST(ShiftCompliance, IsHCHTransposed) {
  RandomSource random(25);
  const Matrix6 C = randomCompliance(random);
  const Vector3 offset = random.vector(0.1);
  Matrix6 H = Matrix6::Identity();
  H.topRightCorner<3, 3>() = -hat(offset);
  EXPECT_TRUE(matrixNear(shiftCompliance(C, offset), H * C * H.transpose(), 1e-15));
}

TEST(ShiftCompliance, MapsAWrenchAtTheNewPointToTheTwistOfTheNewPoint) {
  RandomSource random(26);
  const Matrix6 C_o = randomCompliance(random);
  const Vector3 offset = random.vector(0.1);
  const Wrench at_p = random.wrench(1.0, 1.0);
  Wrench at_o = at_p;
  angular(at_o) += offset.cross(linear(at_p));
  Twist twist = C_o * at_o;
  linear(twist) += angular(twist).cross(offset);
  EXPECT_TRUE(matrixNear(shiftCompliance(C_o, offset) * at_p, twist, 4e-15));
}

TEST(ShiftCompliance, OfTwoShiftsIsThatOfTheirSum) {
  RandomSource random(34);
  const Matrix6 C = randomCompliance(random);
  const Vector3 first = random.vector(0.1), second = random.vector(0.1);
  EXPECT_TRUE(matrixNear(shiftCompliance(shiftCompliance(C, first), second), shiftCompliance(C, first + second),
                         2e-15));
  EXPECT_TRUE(matrixNear(shiftCompliance(shiftCompliance(C, first), -first), C, 2e-15));
  EXPECT_TRUE(matrixNear(shiftCompliance(C, Vector3::Zero()), C, 0.0));
}

TEST(ShiftCompliance, IsTheAdjointOfTheSameAxes) {  // H = Ad^T of the pose of the new point
  RandomSource random(35);
  const Vector3 offset = random.vector(0.1);
  EXPECT_TRUE(matrixNear(twistShift(offset), wrenchAdjoint({Matrix3::Identity(), offset}).transpose(), 0.0));
}

TEST(ComplianceInBodyAxes, MapsBodyWrenchToBodyTwist) {
  RandomSource random(27);
  const Matrix6 C = randomCompliance(random);
  const Matrix3 R = expSo3(random.vector(1.5));
  const Wrench in_body = random.wrench(1.0, 1.0);
  Wrench in_base;
  linear(in_base) = R * linear(in_body);
  angular(in_base) = R * angular(in_body);
  Twist twist = C * in_base;
  linear(twist) = (R.transpose() * linear(twist)).eval();
  angular(twist) = (R.transpose() * angular(twist)).eval();
  EXPECT_TRUE(matrixNear(complianceInBodyAxes(C, R) * in_body, twist, 4e-15));
}

TEST(ResidualTwist, TakesThePredictedPoseToTheMeasuredOne) {
  const Pose predicted{expSo3(Vector3(0.3, 0.2, -0.5)), Vector3(0.01, 0.02, 0.03)};
  const Vector3 turn(0.02, -0.01, 0.03);
  const Pose measured{expSo3(turn) * predicted.R, predicted.p + Vector3(1e-3, 0.0, -2e-3)};
  const Twist residual = residualTwist(measured, predicted);
  EXPECT_LT((linear(residual) - Vector3(1e-3, 0.0, -2e-3)).norm(), 1e-16);  // rounding of 0.03 m
  EXPECT_LT((angular(residual) - turn).norm(), 1e-15);
}

}  // namespace
}  // namespace live_stiffness
