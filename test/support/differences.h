#pragma once
// Five-point central differences, error of order step^4.

#include <functional>

#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

// df/dt at t = 0.
template <class Function>
auto derivativeAtZero(Function f, double step) {
  return ((8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step)).eval();
}

using TipOfWrench = std::function<Pose(const Wrench&)>;

// Compliance of T (base axes) at the wrench `at`, by solving anew around it. expected: any guess at the answer, for
// the choice of steps: each bends the robot by about 0.01 rad.
//
// What it can reach: truncation is of order 0.01^4 = 1e-8 times higher derivatives, a residual of 1e-12 rad in the tip
// over a deflection of 0.01 is 1e-10. So 1e-7 of the norm for tame shapes, 1e-6 near buckling.
inline Matrix6 complianceByDifferences(const TipOfWrench& tip, const Wrench& at, const Matrix6& expected,
                                       double length) {
  constexpr double kBending = 0.01;  // rad
  const Pose X_0 = tip(at);
  Matrix6 C;
  for (int i = 0; i < 6; ++i) {
    const double softness = i < 3 ? expected.topLeftCorner<3, 3>().norm() / length
                                  : expected.bottomRightCorner<3, 3>().norm();
    C.col(i) = derivativeAtZero(
        [&](double t) {
          const Pose X = tip(at + t * Wrench::Unit(i));
          Twist twist;
          linear(twist) = X.p - X_0.p;
          angular(twist) = logSo3(X.R * X_0.R.transpose());
          return twist;
        },
        kBending / softness);
  }
  return C;
}

}  // namespace live_stiffness
