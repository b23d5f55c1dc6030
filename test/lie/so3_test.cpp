#include "live_stiffness/lie/so3.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/differences.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/rotation_samples.h"
#include "support/series_exp.h"

namespace live_stiffness {
namespace {

constexpr double kNearFullTurn = 6.25;

TEST(Hat, IsTheCrossProduct) {
  const Vector3 x(1.0, 2.0, 3.0), y(-4.0, 0.5, 7.0);
  EXPECT_TRUE(matrixNear(hat(x) * y, x.cross(y), 0.0));
}

TEST(ExpSo3, EqualsTheMatrixExponential) {
  for (const Vector3& w : sampleRotations(kNearFullTurn))  // entries of size 1, a dozen roundings
    EXPECT_TRUE(matrixNear(expSo3(w), seriesExp<3>(hat(w)), 2e-15)) << w.transpose();
}

TEST(ExpSo3, IsARotation) {
  for (const Vector3& w : sampleRotations(kNearFullTurn)) {
    const Matrix3 R = expSo3(w);
    EXPECT_TRUE(matrixNear(R * R.transpose(), Matrix3::Identity(), 4e-15)) << w.transpose();
    EXPECT_NEAR(R.determinant(), 1.0, 4e-15);
  }
}

TEST(ExpSo3, OfTheOppositeVectorIsTheInverse) {
  for (const Vector3& w : sampleRotations(kNearFullTurn))
    EXPECT_TRUE(matrixNear(expSo3(-w), expSo3(w).transpose(), 4e-16)) << w.transpose();
}

TEST(ExpSo3, AddsAnglesAboutOneAxis) {
  RandomSource random(15);
  for (double first : sampleAngles(kPi))
    for (double second : sampleAngles(kPi)) {
      const Vector3 axis = random.direction(1.0);
      EXPECT_TRUE(matrixNear(expSo3(first * axis) * expSo3(second * axis), expSo3((first + second) * axis), 4e-15))
          << first << " and " << second;
    }
}

TEST(ExpSo3, TurnsItsVectorWithTheFrame) {  // R exp(w) R^T = exp(R w), the adjoint of SO(3)
  RandomSource random(16);
  for (const Vector3& w : sampleRotations(kNearFullTurn)) {
    const Matrix3 R = expSo3(random.vector(2.0));
    EXPECT_TRUE(matrixNear(R * expSo3(w) * R.transpose(), expSo3(R * w), 4e-15)) << w.transpose();
  }
}

TEST(ExpSo3, KeepsAllDigitsOfATinyRotation) {
  for (const Vector3& w : sampleRotations(1e-8)) {  // w^2 / 2 is below the rounding of 1
    const Matrix3 R = expSo3(w);
    const Vector3 read(R(2, 1), R(0, 2), R(1, 0));
    EXPECT_LE((read - w).cwiseAbs().maxCoeff(), w.cwiseAbs().maxCoeff() * 1e-8) << w.transpose();
    EXPECT_LE((0.5 * (read - Vector3(R(1, 2), R(2, 0), R(0, 1))) - w).cwiseAbs().maxCoeff(),
              w.cwiseAbs().maxCoeff() * 2e-16 + 5e-324) << w.transpose();
  }
}

// Vectors whose length is around a switch.
std::vector<Vector3> around(double switch_angle) {
  RandomSource random(17);
  std::vector<Vector3> vectors;
  for (double factor : kAroundSwitch)
    for (int i = 0; i < 4; ++i) vectors.push_back(random.direction(factor * switch_angle));
  return vectors;
}

TEST(So3, BothBranchesAgreeAtTheSameRotationAroundTheSwitch) {  // to a few roundings of entries of size 1
  for (const Vector3& w : around(kSeriesBelowAngle)) {
    EXPECT_TRUE(matrixNear(expSo3(w, kForceSeries), expSo3(w, kForceClosedForm), 2e-15)) << w.transpose();
    EXPECT_TRUE(matrixNear(leftJacobianSo3(w, kForceSeries), leftJacobianSo3(w, kForceClosedForm), 2e-15));
  }
  const Vector3 u(0.3, -0.7, 0.5);
  for (const Vector3& w : around(kPoleSeriesBelowAngle))
    EXPECT_TRUE(matrixNear(bodyRateToVectorRate(w, u, kForceSeries), bodyRateToVectorRate(w, u, kForceClosedForm),
                           2e-15)) << w.transpose();
}

TEST(LogSo3, InvertsExp) {
  for (const Vector3& w : sampleRotations(3.1))  // R holds a small w relatively, in its off-diagonal part
    EXPECT_LE((logSo3(expSo3(w)) - w).norm(), 2e-15 * std::max(w.norm(), 1e-160)) << w.transpose();
}

TEST(LogSo3, IsInvertedByExpNearAndAtHalfATurnAndBeyond) {
  RandomSource random(12);
  for (double beyond : {-1e-3, -1e-6, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-6, 1e-3, 0.5, 2.0, 3.0})
    for (int i = 0; i < 20; ++i) {
      const Matrix3 R = expSo3(random.direction(kPi + beyond));
      const Vector3 w = logSo3(R);
      EXPECT_LE(w.norm(), kPi + 1e-15);
      EXPECT_TRUE(matrixNear(expSo3(w), R, 4e-15)) << beyond;
    }
}

TEST(LogSo3, IsInvertedByExpAboutTheAxesAtHalfATurn) {  // each has its own largest diagonal entry
  for (int axis = 0; axis < 3; ++axis) {
    Matrix3 R = -Matrix3::Identity();
    R(axis, axis) = 1.0;
    EXPECT_TRUE(matrixNear(logSo3(R).cwiseAbs(), kPi * Vector3::Unit(axis), 0.0));
  }
}

TEST(LogSo3, OfTheInverseIsTheOpposite) {
  for (const Vector3& w : sampleRotations(3.1)) {
    const Matrix3 R = expSo3(w);
    EXPECT_LE((logSo3(R.transpose()) + logSo3(R)).norm(), 2e-15 * w.norm()) << w.transpose();
  }
}

TEST(LogSo3, BothBranchesAgreeAtTheSameRotationAroundTheSwitch) {
  RandomSource random(18);
  constexpr double kForceLinear = 2.0, kForceArcTangent = 0.0;
  for (double angle : {1e-12, 1e-10, 1e-8, 2e-8, 4e-8}) {
    const Matrix3 R = expSo3(random.direction(angle));
    // The first term left out is (angle / 2)^2 / 3 = 1.3e-16 relative at most.
    EXPECT_TRUE(matrixNear(logSo3(R, kForceLinear), logSo3(R, kForceArcTangent), 6e-16 * angle)) << angle;
  }
  const Matrix3 far = expSo3(random.direction(0.1));  // the branches are told apart
  EXPECT_FALSE(matrixNear(logSo3(far, kForceLinear), logSo3(far, kForceArcTangent), 1e-6));
}

TEST(LeftJacobianSo3, EqualsDifferencesOfExp) {
  RandomSource random(13);
  for (const Vector3& w : sampleRotations(kNearFullTurn)) {
    const Vector3 d = random.direction(1.0);
    const auto rotated = [&](double t) { return Matrix3(expSo3(w + t * d) * expSo3(w).transpose()); };
    // step^4 = 1e-12 times a fifth derivative over 30, rounding 1e-16 / 1e-3.
    EXPECT_TRUE(matrixNear(hat(leftJacobianSo3(w) * d), derivativeAtZero(rotated, 1e-3), 2e-12)) << w.transpose();
  }
}

TEST(LeftJacobianSo3, IsTheIntegralOfExp) {
  for (const Vector3& w : sampleRotations(kNearFullTurn)) {
    Matrix3 sum = Matrix3::Zero();
    constexpr int kPanels = 400;
    for (int i = 0; i <= kPanels; ++i)
      sum += (i == 0 || i == kPanels ? 0.5 : 1.0) / kPanels * expSo3(w * i / kPanels);
    const Matrix3 slope = hat(w) * (expSo3(w) - Matrix3::Identity());
    sum -= slope / (12.0 * kPanels * kPanels);
    // Trapezoidal rule with end corrections: the next term of Euler-Maclaurin, and four hundred roundings.
    const double bound = std::pow(w.norm() / kPanels, 4) / 720.0 * w.norm() + 4e-14;
    EXPECT_TRUE(matrixNear(leftJacobianSo3(w), sum, bound)) << w.transpose();
  }
}

TEST(LeftJacobianSo3, TimesItsVectorIsRotationLessIdentity) {  // V(w) hat(w) = exp(w) - I
  for (const Vector3& w : sampleRotations(kNearFullTurn))
    EXPECT_TRUE(matrixNear(leftJacobianSo3(w) * hat(w), expSo3(w) - Matrix3::Identity(), 8e-15)) << w.transpose();
}

TEST(LeftJacobianSo3, OfTheOppositeVectorIsTheRightOne) {  // V(-w) = exp(-w) V(w) = V(w)^T
  for (const Vector3& w : sampleRotations(kNearFullTurn)) {
    EXPECT_TRUE(matrixNear(leftJacobianSo3(-w), expSo3(-w) * leftJacobianSo3(w), 4e-15)) << w.transpose();
    EXPECT_TRUE(matrixNear(leftJacobianSo3(-w), leftJacobianSo3(w).transpose(), 1e-15)) << w.transpose();
  }
}

TEST(BodyRateToVectorRate, EqualsDifferencesOfLog) {
  RandomSource random(14);
  for (const Vector3& w : sampleRotations(3.0)) {  // the differences must not step over half a turn, where log jumps
    const Vector3 u = random.direction(1.0);
    const auto vector = [&](double t) { return logSo3(expSo3(w) * expSo3(t * u)); };
    // As above, but the derivatives of log grow towards 2 pi.
    EXPECT_TRUE(matrixNear(bodyRateToVectorRate(w, u), derivativeAtZero(vector, 1e-3), 1e-11)) << w.transpose();
  }
}

TEST(BodyRateToVectorRate, IsTheInverseOfTheRightJacobian) {
  RandomSource random(19);
  for (const Vector3& w : sampleRotations(kNearFullTurn)) {
    const Vector3 u = random.direction(1.0);
    // The rate grows as 1 / (2 pi - |w|), and so does what its rounding leaves.
    const double bound = 4e-15 * (1.0 + w.norm() / (2.0 * kPi - w.norm()));
    EXPECT_TRUE(matrixNear(leftJacobianSo3(-w) * bodyRateToVectorRate(w, u), u, bound)) << w.transpose();
  }
}

TEST(BodyRateToVectorRate, KeepsTheRateAlongTheVector) {  // a turn about a fixed axis: w' = u
  for (const Vector3& w : sampleRotations(kNearFullTurn)) {
    // w x 2 w is a rounding of w^2, also where the compiler fuses products; d |w| multiplies it towards 2 pi.
    const double bound = 1e-15 * (1.0 + w.squaredNorm()) * (1.0 + angleD(w.squaredNorm()) * w.norm());
    EXPECT_TRUE(matrixNear(bodyRateToVectorRate(w, 2.0 * w), 2.0 * w, bound)) << w.transpose();
  }
}

// A million rotations composed in turn; `next` gives the i-th one.
template <class Next>
Matrix3 composeMillion(Next next, bool keep_orthonormal) {
  Matrix3 R = Matrix3::Identity();
  for (int i = 0; i < 1000000; ++i) {
    R = (R * next(i)).eval();
    if (keep_orthonormal) R = orthonormalised(R);
  }
  return R;
}

// Sixty-four different rotations, over and over in a scrambled order, so that their roundings are by chance.
struct ByChance {
  std::vector<Matrix3> rotations;
  mutable unsigned state = 1;
  ByChance() {
    RandomSource random(20);
    for (int i = 0; i < 64; ++i) rotations.push_back(orthonormalised(expSo3(random.vector(1.5))));
  }
  const Matrix3& operator()(int) const {
    state = 1664525u * state + 1013904223u;
    return rotations[state >> 26];
  }
};

TEST(Orthonormalised, SquaresTheDefect) {
  RandomSource random(21);
  for (double size : {1e-3, 1e-5, 1e-7, 1e-9, 1e-12}) {
    Matrix3 noise;
    noise << random.vector(size), random.vector(size), random.vector(size);
    const Matrix3 R = expSo3(random.vector(1.5)) + noise;
    const Matrix3 mended = orthonormalised(R);
    const double before = orthonormalityError(R);
    EXPECT_GT(before, 0.1 * size);
    EXPECT_LE(orthonormalityError(mended), before * before + 1e-15) << size;
    EXPECT_LE((mended - R).norm(), 0.51 * before + 1e-15) << size;  // goes no further than it must, to first order
  }
}

TEST(Orthonormalised, KeepsAMillionCompositionsOrthonormal) {
  const Matrix3 turn = expSo3(Vector3(0.3, -0.2, 0.5));
  EXPECT_LE(orthonormalityError(composeMillion(ByChance(), true)), 2e-15);
  EXPECT_LE(orthonormalityError(composeMillion([&](int) { return turn; }, true)), 2e-15);
  // and it does not spoil the rotation: a million times one turn is one large turn about its axis
  const Vector3 axis = Vector3(0.3, -0.2, 0.5).normalized();
  EXPECT_TRUE(matrixNear(composeMillion([&](int) { return turn; }, true) * axis, axis, 1e-9));
}

TEST(Orthonormalised, IsNeededByAMillionCompositions) {
  // What plain products do: the defect grows steadily if one rotation is repeated (measured 5e-11 to 3e-10), and
  // about as the square root of the number of products if they differ (measured 2e-12 to 7e-12).
  const Matrix3 turn = expSo3(Vector3(0.3, -0.2, 0.5));
  const double repeated = orthonormalityError(composeMillion([&](int) { return turn; }, false));
  const double by_chance = orthonormalityError(composeMillion(ByChance(), false));
  EXPECT_GT(repeated, 1e-12);
  EXPECT_LT(repeated, 1e-9);
  EXPECT_GT(by_chance, 1e-14);
  EXPECT_LT(by_chance, 1e-10);
}

}  // namespace
}  // namespace live_stiffness
