#include "gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace live_stiffness {
namespace {

// 1e-15 and 2e-15: sums of at most twelve rounded terms of size 1.

TEST(GaussLegendre, IntegratesPolynomialsUpToItsDegreeAndNoFurther) {
  for (int n = 1; n <= kMaxNodes; ++n) {
    const GaussLegendre& table = gaussLegendre(n);
    const auto error = [&](int degree) {
      double sum = 0.0;
      for (int i = 0; i < kMaxNodes; ++i) sum += table.b[i] * std::pow(table.c[i], degree);
      return std::abs(sum - 1.0 / (degree + 1));
    };
    for (int degree = 0; degree < 2 * n; ++degree) EXPECT_LT(error(degree), 1e-15) << n << " " << degree;
    if (n > 10) continue;  // beyond, even the first error is below rounding
    EXPECT_GT(error(2 * n), 1e-14) << n;
  }
}

TEST(GaussLegendre, RungeKuttaMatrixIntegratesUpToEachNodeAndTheEnd) {
  for (int n = 1; n < kMaxNodes; ++n) {
    const GaussLegendre& table = gaussLegendre(n);
    EXPECT_EQ(table.c[n], 1.0);
    for (int i = 0; i <= n; ++i)
      for (int degree = 0; degree < n; ++degree) {
        double sum = 0.0;
        for (int j = 0; j < n; ++j) sum += table.a[j][i] * std::pow(table.c[j], degree);
        EXPECT_NEAR(sum, std::pow(table.c[i], degree + 1) / (degree + 1), 1e-15) << n << " " << i << " " << degree;
      }
  }
}

TEST(GaussLegendre, CoefficientsAreThoseOfTheLegendrePolynomials) {
  for (int n = 1; n <= kMaxNodes; ++n) {
    const GaussLegendre& table = gaussLegendre(n);
    for (int k = 0; k < n; ++k)
      for (int degree = 0; degree < n; ++degree) {
        double sum = 0.0;
        for (int j = 0; j < n; ++j) sum += table.legendre[k][j] * std::legendre(degree, 2.0 * table.c[j] - 1.0);
        EXPECT_NEAR(sum, k == degree ? 1.0 : 0.0, 1e-13) << n << " " << k << " " << degree;  // factors up to 2 n
      }
  }
}

TEST(NodeTransfer, CarriesPolynomialsThatStartAtZeroToOtherNodes) {
  for (int from : {2, 3, 7})
    for (int to : {4, 8, 12}) {
      const NodeTransfer transfer = makeTransfer(from, to);
      for (int i = 0; i < to; ++i)
        for (int degree = 1; degree <= from; ++degree) {
          const double x = gaussLegendre(to).c[i];
          double value = 0.0, slope = 0.0;
          for (int j = 0; j < from; ++j) {
            const double given = std::pow(gaussLegendre(from).c[j], degree);
            value += transfer.value[j][i] * given;
            slope += transfer.slope[j][i] * given;
          }
          // The first node of many is near 0, so that its entries are as large as 1 / c: rounding grows by that.
          EXPECT_NEAR(value, std::pow(x, degree), 1e-14) << from << " " << to;
          EXPECT_NEAR(slope, degree * std::pow(x, degree - 1), 2e-13) << from << " " << to;
        }
    }
}

TEST(IntegralWeights, IntegratePolynomialsThroughTheNodesUpToX) {
  for (int n = 1; n <= kMaxNodes; ++n)
    for (double x : {0.0, 1e-9, 0.2, 0.5, 0.83, 1.0}) {
      double weight[kMaxNodes];
      integralWeights(n, x, weight);
      for (int power = 0; power < n; ++power) {
        double integral = 0.0;
        for (int j = 0; j < n; ++j) integral += weight[j] * std::pow(gaussLegendre(n).c[j], power);
        EXPECT_NEAR(integral, std::pow(x, power + 1) / (power + 1), 1e-15) << n << " nodes, power " << power;
      }
      for (int j = 0; x == 0.0 && j < n; ++j) EXPECT_EQ(weight[j], 0.0);
    }
}

}  // namespace
}  // namespace live_stiffness
