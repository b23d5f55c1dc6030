#pragma once
// The four even functions of a rotation angle t that the exponential of SO(3) and its derivatives are made of:
//   a = sin(t) / t,  b = (1 - cos(t)) / t^2,  c = (t - sin(t)) / t^3,  d = (1 - a / (2 b)) / t^2.
// All are analytic at t = 0. Their argument is x = t^2. Below a switch angle they are series in x, above it closed forms.
// Relative error below 6e-16. (For a near its zero at pi: absolute error. For b and d towards 2 pi: times t / (2 pi - t),
// the effect of rounding x.) Inline, because they are called very often. The switch is an argument so that tests can
// force either branch at the same angle.

#include <cmath>

namespace live_stiffness {

// Below this angle (rad) a, b and c are Taylor series of ten terms; the first term left out is below 5e-17 of the sum.
// Above it they are closed forms, in which c loses less than two bits.
constexpr double kSeriesBelowAngle = 1.45;

// The same for d. Its closed form has the difference of b and a/2, which loses no digits only where a is negative.
constexpr double kPoleSeriesBelowAngle = 3.14159265358979323846;

namespace angle_series {

constexpr double kA[] = {1, -0.16666666666666666, 0.0083333333333333332, -0.00019841269841269841,
    2.7557319223985893e-06, -2.505210838544172e-08, 1.6059043836821613e-10, -7.6471637318198164e-13,
    2.8114572543455206e-15, -8.2206352466243295e-18};
constexpr double kB[] = {0.5, -0.041666666666666664, 0.0013888888888888889, -2.4801587301587302e-05,
    2.7557319223985888e-07, -2.08767569878681e-09, 1.1470745597729725e-11, -4.7794773323873853e-14,
    1.5619206968586225e-16, -4.1103176233121648e-19};
constexpr double kC[] = {0.16666666666666666, -0.0083333333333333332, 0.00019841269841269841,
    -2.7557319223985893e-06, 2.505210838544172e-08, -1.6059043836821613e-10, 7.6471637318198164e-13,
    -2.8114572543455206e-15, 8.2206352466243295e-18, -1.9572941063391263e-20};
// d = sum over k >= 1 of 2 / ((2 pi k)^2 - x), the partial fractions of the cotangent. The poles of k = 1 and 2 are
// kept; these are the Taylor coefficients of all others, 2 (zeta(2n) - 1 - 4^-n) / (2 pi)^2n for n = 1..10. They
// converge as (x / 36 pi^2)^n: the first term left out is below 2e-17 of the sum at pi. Everything is positive.
constexpr double kPole1 = 39.478417604357432, kPole2 = 157.91367041742973;  // (2 pi)^2, (4 pi)^2
constexpr double kD[] = {0.020007593556872226, 2.543812068862562e-05, 5.5845683904944151e-08,
    1.4088241574761048e-10, 3.7567162002157979e-13, 1.0280125375360461e-15, 2.8500221292137911e-18,
    7.9555754107198446e-21, 2.2289326645537012e-23, 6.2574711508057725e-26};

inline double sum(const double (&k)[10], double x) {
  double value = k[9];
  for (int i = 8; i >= 0; --i) value = value * x + k[i];
  return value;
}

inline bool holds(double x, double series_below) { return x < series_below * series_below; }

}  // namespace angle_series

inline double angleA(double x, double series_below = kSeriesBelowAngle) {
  if (angle_series::holds(x, series_below)) return angle_series::sum(angle_series::kA, x);
  const double t = std::sqrt(x);
  return std::sin(t) / t;
}

inline double angleB(double x, double series_below = kSeriesBelowAngle) {
  if (angle_series::holds(x, series_below)) return angle_series::sum(angle_series::kB, x);
  const double half_sine = std::sin(0.5 * std::sqrt(x));
  return 2.0 * half_sine * half_sine / x;
}

inline double angleC(double x, double series_below = kSeriesBelowAngle) {
  if (angle_series::holds(x, series_below)) return angle_series::sum(angle_series::kC, x);
  return (1.0 - angleA(x, series_below)) / x;
}

// Has a pole at t = 2 pi.
inline double angleD(double x, double series_below = kPoleSeriesBelowAngle) {
  using namespace angle_series;
  if (holds(x, series_below)) return 2.0 / (kPole1 - x) + (2.0 / (kPole2 - x) + sum(kD, x));
  const double b = angleB(x, 0.0);
  return (b - 0.5 * angleA(x, 0.0)) / (x * b);
}

}  // namespace live_stiffness
