#include "lie/cayley.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/differences.h"
#include "support/matrix_near.h"
#include "support/rotation_samples.h"

namespace live_stiffness {
namespace {

using Real = long double;
using RealMatrix3 = Eigen::Matrix<Real, 3, 3>;
using RealVector3 = Eigen::Matrix<Real, 3, 1>;

// Cayley vector of a rotation vector, rounded once: 2 tan(t / 2) / t w.
Vector3 cayleyOf(const Vector3& w) {
  const RealVector3 w_long = w.cast<Real>();
  const Real t = std::hypot(std::hypot(w_long.x(), w_long.y()), w_long.z());
  return t == 0 ? w : Vector3((2 * std::tan(t / 2) / t * w_long).cast<double>());
}

// By the Cayley transform itself, (I - hat(g)/2)^-1 (I + hat(g)/2), in long double.
RealMatrix3 transform(const RealVector3& g) {
  RealMatrix3 half;
  half << 0, -g.z(), g.y(), g.z(), 0, -g.x(), -g.y(), g.x(), 0;
  half /= 2;
  return (RealMatrix3::Identity() - half).inverse() * (RealMatrix3::Identity() + half);
}

// Below half a turn, by ever less.
std::vector<Vector3> rotations() {
  std::vector<Vector3> vectors = sampleRotations(3.1);
  RandomSource random(41);
  for (double below : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10})
    for (int i = 0; i < 4; ++i) vectors.push_back(random.direction(kPi - below));
  return vectors;
}

TEST(CayleySo3, IsTheCayleyTransform) {
  for (const Vector3& w : rotations()) {
    const Vector3 g = cayleyOf(w);
    if (g.norm() > 1e6) continue;  // there the reference itself is 1e-13
    EXPECT_TRUE(matrixNear(cayleySo3(g), transform(g.cast<Real>()).cast<double>(), 1e-15)) << w.transpose();
  }
}

TEST(CayleySo3, EqualsExpOfTheSameRotation) {  // a dozen roundings of entries of size 1
  for (const Vector3& w : rotations())
    EXPECT_TRUE(matrixNear(cayleySo3(cayleyOf(w)), expSo3(w), 2e-15)) << w.transpose();
}

TEST(CayleySo3, IsARotation) {
  for (const Vector3& w : rotations()) {
    const Matrix3 R = cayleySo3(cayleyOf(w));
    EXPECT_TRUE(matrixNear(R * R.transpose(), Matrix3::Identity(), 4e-15)) << w.transpose();
    EXPECT_NEAR(R.determinant(), 1.0, 4e-15);
  }
}

TEST(CayleySo3, OfTheOppositeVectorIsTheInverse) {
  for (const Vector3& w : rotations())
    EXPECT_TRUE(matrixNear(cayleySo3(-cayleyOf(w)), cayleySo3(cayleyOf(w)).transpose(), 4e-16)) << w.transpose();
}

TEST(CayleySo3, ComposesRationally) {  // g of R(g) R(h) = (g + h + g x h / 2) / (1 - g . h / 4)
  RandomSource random(42);
  for (const Vector3& w : sampleRotations(2.0)) {
    const Vector3 g = cayleyOf(w), h = random.vector(0.3);
    const Vector3 product = (g + h + 0.5 * g.cross(h)) / (1.0 - 0.25 * g.dot(h));
    EXPECT_TRUE(matrixNear(cayleySo3(g) * cayleySo3(h), cayleySo3(product), 2e-15)) << w.transpose();
  }
}

TEST(InverseCayleySo3, InvertsToAllDigitsFromZeroUp) {
  for (const Vector3& w : sampleRotations(2.0)) {
    const Vector3 g = cayleyOf(w);
    EXPECT_LE((inverseCayleySo3(cayleySo3(g)) - g).norm(), 4e-15 * std::max(g.norm(), 1e-160)) << w.transpose();
  }
}

TEST(InverseCayleySo3, IsInvertedUpToHalfATurn) {  // g itself is as ill-conditioned as R: it grows beyond bounds
  for (const Vector3& w : rotations()) {
    const Matrix3 R = cayleySo3(cayleyOf(w));
    EXPECT_TRUE(matrixNear(cayleySo3(inverseCayleySo3(R)), R, 4e-15)) << w.transpose();
  }
}

TEST(InverseCayleySo3, TellsHalfATurn) {
  EXPECT_GT(inverseCayleySo3(expSo3(Vector3(0.0, kPi, 0.0))).norm(), 1e15);
}

TEST(BodyRateToCayleyRate, MovesTheRotationByTheBodyRate) {
  // dR/dg g' = R hat(u), with dR/dg by the quotient rule on I + f (hat(g) + hat(g)^2 / 2), in long double.
  RandomSource random(43);
  const auto hatOf = [](const RealVector3& x) {
    RealMatrix3 x_hat;
    x_hat << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0;
    return x_hat;
  };
  for (const Vector3& w : rotations()) {
    const Vector3 u = random.direction(1.0);
    const RealVector3 g = cayleyOf(w).cast<Real>();
    const RealVector3 rate = bodyRateToCayleyRate(g.cast<double>(), u).cast<Real>();
    const RealMatrix3 G = hatOf(g), dG = hatOf(rate);
    const Real f = 4 / (4 + g.squaredNorm()), df = -f * f / 2 * g.dot(rate);
    const RealMatrix3 actual = df * (G + G * G / 2) + f * (dG + (dG * G + G * dG) / 2);
    const RealMatrix3 R = RealMatrix3::Identity() + f * (G + G * G / 2);
    // g' is of size g^2 and dR/dg of size 1/g, so the rounding of g' counts g-fold. (Never seen by a solver: it is
    // what the chart costs near half a turn.)
    const double bound = 2e-15 * (1.0 + static_cast<double>(g.norm()));
    EXPECT_TRUE(matrixNear(actual.cast<double>(), (R * hatOf(u.cast<Real>())).cast<double>(), bound))
        << w.transpose();
  }
}

TEST(BodyRateToCayleyRate, EqualsDifferencesOfTheInverse) {
  RandomSource random(44);
  for (const Vector3& w : sampleRotations(2.0)) {
    const Vector3 u = random.direction(1.0);
    const Matrix3 R = cayleySo3(cayleyOf(w));
    const auto vector = [&](double t) { return inverseCayleySo3(R * expSo3(t * u)); };
    // step^4 = 1e-12 times a fifth derivative of a tangent, rounding 1e-16 / 1e-3.
    EXPECT_TRUE(matrixNear(bodyRateToCayleyRate(cayleyOf(w), u), derivativeAtZero(vector, 1e-3), 4e-11))
        << w.transpose();
  }
}

TEST(BodyRateToCayleyRate, OfAFixedAxisIsTheDerivativeOfTheTangent) {  // g = 2 tan(s / 2): g' = 1 + g^2 / 4
  const Vector3 axis(0.6, 0.0, 0.8);
  for (double angle : sampleAngles(3.1)) {
    const Vector3 g = cayleyOf(angle * axis);
    EXPECT_LE((bodyRateToCayleyRate(g, axis) - (1.0 + 0.25 * g.squaredNorm()) * axis).norm(),
              1e-15 * (1.0 + g.squaredNorm())) << angle;
  }
}

}  // namespace
}  // namespace live_stiffness
