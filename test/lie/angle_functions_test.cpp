#include "live_stiffness/lie/angle_functions.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "live_stiffness/conventions.h"

namespace live_stiffness {
namespace {

using Real = long double;

// Reference: Taylor series of sum_k (-1)^k x^k / (2k + first)!, in long double; no cancellation below t = 2, and 64
// bits of mantissa leave 1e-17 relative up to pi.
Real series(Real x, int first) {
  Real term = 1;
  for (int k = 2; k <= first; ++k) term /= k;
  Real sum = 0;
  for (int k = 0; k < 40; ++k) {
    sum += term;
    term *= -x / ((2 * k + first + 1) * (2 * k + first + 2));
  }
  return sum;
}

// (b - a/2) / x = sum_k (-1)^k x^k (1/(2 (2k+3)!) - 1/(2k+4)!), so c/2 - (1/2 - b)/x.
Real referenceD(Real x) { return (series(x, 3) / 2 - series(x, 4)) / series(x, 2); }

struct Case {
  const char* name;
  double (*function)(double, double);
  std::function<Real(Real)> reference;
};

const Case kCases[] = {
    {"a", angleA, [](Real x) { return series(x, 1); }},
    {"b", angleB, [](Real x) { return series(x, 2); }},
    {"c", angleC, [](Real x) { return series(x, 3); }},
    {"d", angleD, referenceD},
};

double relativeError(const Case& c, double t, double series_below) {
  const double x = t * t;
  const Real exact = c.reference(x);
  return static_cast<double>(std::abs((c.function(x, series_below) - exact) / exact));
}

TEST(AngleFunctions, AreExactToRoundingFromZeroToThree) {
  for (const Case& c : kCases)
    for (double t : {0.0, 1e-300, 1e-12, 1e-8, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 0.9, 0.999999, 1.0, 1.000001, 1.2, 2.0,
                     3.0}) {
      // Worst is d just above the switch, where b - a/2 is a twelfth of b: two roundings of 1.1e-16 times 12. (Near pi
      // a passes through zero, and no relative bound can hold.)
      EXPECT_LE(relativeError(c, t, kSeriesBelowAngle), 3e-15) << c.name << " at " << t;
    }
}

TEST(AngleFunctions, BothBranchesAgreeAtTheSameAngleAroundTheSwitch) {
  for (const Case& c : kCases)
    for (double t : {0.8, 0.9, 0.999, 1.0, 1.001, 1.1}) {
      // The first term left out at t = 1.1 is below 1e-18; the closed form costs what it costs above, times
      // 1.6 at t = 0.8, as b - a/2 falls with t^2.
      EXPECT_LE(relativeError(c, t, 2.0), 4e-16) << c.name << " by series at " << t;
      EXPECT_LE(relativeError(c, t, 0.0), 5e-15) << c.name << " in closed form at " << t;
    }
}

TEST(AngleFunctions, SwitchIsWhereItIsSaidToBe) {
  const double below = 0.25, x = below * below;
  // Far below the switch the closed form of c has lost digits that the series has not: the branches are told apart.
  EXPECT_NE(angleC(1e-6, 0.0), angleC(1e-6, 1.0));
  EXPECT_EQ(angleC(std::nextafter(x, 0.0), below), angleC(std::nextafter(x, 0.0), 1e3));
  EXPECT_EQ(angleC(x, below), angleC(x, 0.0));
}

TEST(AngleFunctions, TakeTheirLimitsAtZero) {
  EXPECT_EQ(angleA(0.0), 1.0);
  EXPECT_EQ(angleB(0.0), 0.5);
  EXPECT_DOUBLE_EQ(angleC(0.0), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(angleD(0.0), 1.0 / 12.0);
}

}  // namespace
}  // namespace live_stiffness
