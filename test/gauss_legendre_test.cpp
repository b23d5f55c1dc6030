#include "live_stiffness/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace live_stiffness {
namespace {

// 1e-15 throughout: sums of six rounded terms of size 1.

TEST(GaussLegendre, IntegratesPolynomialsUpToItsDegreeAndNoFurther) {
  const GaussLegendre& table = gaussLegendre();
  const auto error = [&](int degree) {
    double sum = 0.0;
    for (int i = 0; i < kStages; ++i) sum += table.b[i] * std::pow(table.c[i], degree);
    return std::abs(sum - 1.0 / (degree + 1));
  };
  for (int degree = 0; degree < 2 * kStages; ++degree) EXPECT_LT(error(degree), 1e-15) << degree;
  EXPECT_GT(error(2 * kStages), 1e-9);
}

TEST(GaussLegendre, RungeKuttaMatrixIntegratesUpToEachNode) {
  const GaussLegendre& table = gaussLegendre();
  for (int i = 0; i < kStages; ++i)
    for (int degree = 0; degree < kStages; ++degree) {
      double sum = 0.0;
      for (int j = 0; j < kStages; ++j) sum += table.a[i][j] * std::pow(table.c[j], degree);
      EXPECT_NEAR(sum, std::pow(table.c[i], degree + 1) / (degree + 1), 1e-15) << i << " " << degree;
    }
}

TEST(GaussLegendre, TopAndBelowTopAreTheHighestLegendreCoefficients) {
  const GaussLegendre& table = gaussLegendre();
  const auto coefficient = [&](const std::array<double, kStages>& row, auto f) {
    double sum = 0.0;
    for (int i = 0; i < kStages; ++i) sum += row[i] * f(2.0 * table.c[i] - 1.0);
    return sum;
  };
  static_assert(kStages == 6, "the polynomials below are of degree kStages - 1 and one less");
  const auto P5 = [](double x) { return (63 * std::pow(x, 5) - 70 * x * x * x + 15 * x) / 8; };
  const auto P4 = [](double x) { return (35 * std::pow(x, 4) - 30 * x * x + 3) / 8; };
  const auto P3 = [](double x) { return (5 * x * x * x - 3 * x) / 2; };
  EXPECT_NEAR(coefficient(table.top, P5), 1.0, 1e-14);
  EXPECT_NEAR(coefficient(table.top, P4), 0.0, 1e-14);
  EXPECT_NEAR(coefficient(table.below_top, P5), 0.0, 1e-14);
  EXPECT_NEAR(coefficient(table.below_top, P4), 1.0, 1e-14);
  EXPECT_NEAR(coefficient(table.below_top, P3), 0.0, 1e-14);
}

}  // namespace
}  // namespace live_stiffness
