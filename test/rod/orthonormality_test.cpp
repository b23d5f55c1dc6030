#include "support/orthonormality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

constexpr OrthonormalityCase kNcm;
constexpr OrthonormalityCase kNpcc{Stepping::kFixedStep, false};

TEST(Orthonormality, OfRungeKuttaHasTheOrderOfFigure17) {
  // At the tip 1e-10 to 1e-9 once there are elements enough; along the arc below 2.5e-10 with fifty, as far as that
  // can be read off a plot: 2.6e-10 here, with parameters inferred from another table.
  for (int elements : {40, 45, 50}) {
    const double tip = rungeKuttaOrthonormality(kFigure17, elements).back();
    EXPECT_GT(tip, 1e-10) << elements;
    EXPECT_LT(tip, 1e-9) << elements;
  }
  const std::vector<double> along = rungeKuttaOrthonormality(kFigure17, 50);
  EXPECT_TRUE(std::is_sorted(along.begin(), along.end()));  // it only accumulates
  EXPECT_NEAR(along.back(), 2.5e-10, 0.15e-10);
}

TEST(Orthonormality, OfRungeKuttaFallsWithTheFifthPowerOfElements) {
  // Under a constant curvature each step has |1 + ix - x^2/2 - ix^3/6 + x^4/24|^2 - 1 = -x^6/72 + x^8/576 in the two
  // directions across the axis, so sqrt(2) times as much in the Frobenius norm.
  for (const OrthonormalityCase& which : {kFigure17, kNpcc})
    for (int elements : {10, 20, 50}) {
      const double x = unloadedBending(which) / elements;
      const double expected = std::sqrt(2.0) * elements * (std::pow(x, 6) / 72.0 - std::pow(x, 8) / 576.0);
      EXPECT_NEAR(rungeKuttaOrthonormality(which, elements).back(), expected, 1e-3 * expected) << elements;
    }
}

TEST(Orthonormality, OfRungeKuttaIsWorseInTheNonlinearModelUnderWeight) {
  // It bends twice as far as the linear one: an order of magnitude more than the figure shows.
  const double tip = rungeKuttaOrthonormality(kNcm, 50).back();
  EXPECT_GT(tip, 2e-9);
  EXPECT_LT(tip, 2e-8);
}

TEST(Orthonormality, OfTheSolverIsRounding) {
  for (const OrthonormalityCase& which : {kNcm, kNpcc, kFigure17})
    for (double error : solverOrthonormality(which, 51).errors) EXPECT_LE(error, 4e-15);
}

}  // namespace
}  // namespace live_stiffness
