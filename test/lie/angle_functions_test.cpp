#include "live_stiffness/lie/angle_functions.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "support/rotation_samples.h"

namespace live_stiffness {
namespace {

using Real = long double;

// Reference: Taylor series of sum_k (-1)^k x^k / (2k + first)!, in long double: relative error 1e-17 up to pi, and
// 1e-16 at 6.2, where the sum of b is a two-thousandth of its largest term.
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
  double switch_angle;
};

const Case kCases[] = {
    {"a", angleA, [](Real x) { return series(x, 1); }, kSeriesBelowAngle},
    {"b", angleB, [](Real x) { return series(x, 2); }, kSeriesBelowAngle},
    {"c", angleC, [](Real x) { return series(x, 3); }, kSeriesBelowAngle},
    {"d", angleD, referenceD, kPoleSeriesBelowAngle},
};

constexpr double kRounding = 6e-16;  // five roundings of 1.1e-16; the worst is c just above its switch

// Relative error; of a beyond 2 rad the absolute one.
double relativeError(const Case& c, double t, double series_below) {
  const double x = t * t;
  const Real exact = c.reference(x);
  const Real scale = c.function == angleA && t > 2.0 ? 1 : exact;  // it has zeros at pi and 2 pi
  return static_cast<double>(std::abs((c.function(x, series_below) - exact) / scale));
}

// Sampled angles, and a thousand on either side of each switch.
std::vector<double> angles() {
  std::vector<double> result = sampleAngles(2.0 * kPi);
  RandomSource random(10);
  for (double low : {0.0, 0.5 * kSeriesBelowAngle, kSeriesBelowAngle, 2.0, 3.0, kPi})
    for (int i = 0; i < 1000; ++i) result.push_back(random.uniform(low, low + 1.0));
  return result;
}

TEST(AngleFunctions, AreExactToRoundingFromZeroToNearAFullTurn) {
  for (const Case& c : kCases)
    for (double t : angles()) {
      // b has a double zero and d a pole at 2 pi: there the rounding of x counts as often as its distance goes into t.
      const double bound = (c.name[0] == 'b' || c.name[0] == 'd') && t > 4.0 ? t / (2.0 * kPi - t) : 1.0;
      EXPECT_LE(relativeError(c, t, c.switch_angle), bound * kRounding) << c.name << " at " << t;
    }
}

TEST(AngleFunctions, DefaultsAreTheSwitchesTested) {
  for (double t : {kSeriesBelowAngle * 0.999, kSeriesBelowAngle * 1.001, kPi * 0.999, kPi * 1.001}) {
    const double x = t * t;
    EXPECT_EQ(angleA(x), angleA(x, kSeriesBelowAngle));
    EXPECT_EQ(angleB(x), angleB(x, kSeriesBelowAngle));
    EXPECT_EQ(angleC(x), angleC(x, kSeriesBelowAngle));
    EXPECT_EQ(angleD(x), angleD(x, kPoleSeriesBelowAngle));
  }
}

TEST(AngleFunctions, BothBranchesAreExactAtTheSameAngleAroundTheSwitch) {
  for (const Case& c : kCases)
    for (double factor : kAroundSwitch) {
      const double t = factor * c.switch_angle;
      // The first term left out grows with t^20: by 2.7 at 1.05, to 1.3e-16 at most.
      EXPECT_LE(relativeError(c, t, kForceSeries), kRounding) << c.name << " by series at " << t;
      EXPECT_LE(relativeError(c, t, kForceClosedForm), kRounding) << c.name << " in closed form at " << t;
    }
}

TEST(AngleFunctions, ClosedFormsOfAAndBHoldAtAnyAngle) {
  for (double t : sampleAngles(kSeriesBelowAngle)) {
    if (t < 1e-150) continue;  // t^2 underflows, and 0 / 0 is why there is a series
    EXPECT_LE(relativeError(kCases[0], t, kForceClosedForm), kRounding) << t;
    EXPECT_LE(relativeError(kCases[1], t, kForceClosedForm), kRounding) << t;
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
