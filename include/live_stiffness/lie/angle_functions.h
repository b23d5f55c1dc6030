#pragma once
// The four even functions of a rotation angle t that the exponential of SO(3) and its derivatives are made of:
//   a = sin(t) / t,  b = (1 - cos(t)) / t^2,  c = (t - sin(t)) / t^3,  d = (1 - a / (2 b)) / t^2.
// All are analytic at t = 0. They take x = t^2, and come from their Taylor series in x below a switch angle and from
// the closed form above. Inline, because they are the innermost code of the rod solver.

#include <cmath>

namespace live_stiffness {

// Below this angle (rad): series of ten terms, the first one left out is below 1e-19. Above: closed form. Both are
// exact to rounding at the switch; it is an argument so that tests can force either branch at the same angle.
constexpr double kSeriesBelowAngle = 1.0;

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
// Of (b - a/2) / x = d b, which has no cancellation: 1 / (2 (2k+3)!) - 1 / (2k+4)!, signs alternating.
constexpr double kG[] = {0.041666666666666664, -0.0027777777777777779, 7.4404761904761911e-05,
    -1.1022927689594355e-06, 1.043837849393405e-08, -6.882447358637835e-11, 3.3456341326711696e-13,
    -1.249536557486898e-15, 3.6992858609809485e-18, -8.8967913924505729e-21};

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

inline double angleD(double x, double series_below = kSeriesBelowAngle) {
  const double b = angleB(x, series_below);
  if (angle_series::holds(x, series_below)) return angle_series::sum(angle_series::kG, x) / b;
  return (b - 0.5 * angleA(x, series_below)) / (x * b);
}

}  // namespace live_stiffness
