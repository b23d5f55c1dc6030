#include "live_stiffness/lie/so3.h"

#include <gtest/gtest.h>

#include "support/differences.h"
#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/series_exp.h"

namespace live_stiffness {
namespace {

// Zero, tiny, on both sides of the series' switch, large, and random directions throughout.
std::vector<Vector3> rotationVectors() {
  RandomSource random(11);
  std::vector<Vector3> vectors{Vector3::Zero()};
  for (double angle : {1e-300, 1e-12, 1e-7, 1e-3, 0.1, 0.999999, 1.000001, 1.7, 2.5, 3.1})
    for (int i = 0; i < 4; ++i) vectors.push_back(random.direction(angle));
  return vectors;
}

TEST(Hat, IsTheCrossProduct) {
  const Vector3 x(1.0, 2.0, 3.0), y(-4.0, 0.5, 7.0);
  EXPECT_TRUE(matrixNear(hat(x) * y, x.cross(y), 0.0));
}

TEST(ExpSo3, EqualsTheMatrixExponential) {
  for (const Vector3& w : rotationVectors())  // entries of size 1, a dozen roundings
    EXPECT_TRUE(matrixNear(expSo3(w), seriesExp<3>(hat(w)), 2e-15)) << w.transpose();
}

TEST(ExpSo3, IsARotation) {
  for (const Vector3& w : rotationVectors()) {
    const Matrix3 R = expSo3(w);
    EXPECT_TRUE(matrixNear(R * R.transpose(), Matrix3::Identity(), 4e-15)) << w.transpose();
    EXPECT_NEAR(R.determinant(), 1.0, 4e-15);
  }
}

TEST(LogSo3, InvertsExp) {
  for (const Vector3& w : rotationVectors())  // R holds a small w to 1e-16 absolutely, not relatively
    EXPECT_TRUE(matrixNear(logSo3(expSo3(w)), w, 4e-15)) << w.transpose();
}

TEST(LogSo3, IsInvertedByExpNearAndAtHalfATurn) {
  RandomSource random(12);
  for (double below : {1e-3, 1e-6, 1e-9, 1e-15, 0.0}) {
    const Matrix3 R = expSo3(random.direction(kPi - below));
    const Vector3 w = logSo3(R);
    EXPECT_LE(w.norm(), kPi + 1e-15);
    EXPECT_TRUE(matrixNear(expSo3(w), R, 4e-15)) << below;
  }
}

TEST(LeftJacobianSo3, EqualsDifferencesOfExp) {
  RandomSource random(13);
  for (const Vector3& w : rotationVectors()) {
    const Vector3 d = random.direction(1.0);
    const auto rotated = [&](double t) { return Matrix3(expSo3(w + t * d) * expSo3(w).transpose()); };
    // step^4 = 1e-12 times a fifth derivative over 30, rounding 1e-16 / 1e-3.
    EXPECT_TRUE(matrixNear(hat(leftJacobianSo3(w) * d), derivativeAtZero(rotated, 1e-3), 2e-12)) << w.transpose();
  }
}

TEST(LeftJacobianSo3, IsTheIntegralOfExp) {
  for (const Vector3& w : rotationVectors()) {
    Matrix3 sum = Matrix3::Zero();
    constexpr int kPanels = 400;  // the trapezoidal rule with end corrections: error (|w| / 400)^4 / 720 < 1e-11
    for (int i = 0; i <= kPanels; ++i)
      sum += (i == 0 || i == kPanels ? 0.5 : 1.0) / kPanels * expSo3(w * i / kPanels);
    const Matrix3 slope = hat(w) * (expSo3(w) - Matrix3::Identity());
    sum -= slope / (12.0 * kPanels * kPanels);
    EXPECT_TRUE(matrixNear(leftJacobianSo3(w), sum, 1e-11)) << w.transpose();
  }
}

TEST(BodyRateToVectorRate, EqualsDifferencesOfLog) {
  RandomSource random(14);
  for (const Vector3& w : rotationVectors()) {
    if (w.norm() > 3.0) continue;  // the differences would step over half a turn, where log jumps
    const Vector3 u = random.direction(1.0);
    const auto vector = [&](double t) { return logSo3(expSo3(w) * expSo3(t * u)); };
    // As above, but the derivatives of log grow towards 2 pi.
    EXPECT_TRUE(matrixNear(bodyRateToVectorRate(w, u), derivativeAtZero(vector, 1e-3), 1e-11)) << w.transpose();
  }
}

}  // namespace
}  // namespace live_stiffness
