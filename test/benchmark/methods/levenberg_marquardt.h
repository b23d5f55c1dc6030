#pragma once
// Levenberg's method as Till's rod code (ContinuumRobotExamples, convexoptimization.h) uses it: a fresh Jacobian of forward
// differences in every iteration, damped normal equations, the damping halved before each and doubled until the residual
// shrinks. Increments, damping and bound on trials are his; his tolerance of 1e-6 is too coarse to differentiate the result.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace live_stiffness {

// Makes residual(y) smaller than the tolerance, or nearly where rounding ends the search. The last call of `residual` is with
// the y that is returned. Vector: of fixed or of run-time size.
template <class Vector, class Residual>
bool levenbergMarquardt(const Residual& residual, double tolerance, Vector& y) {
  using Matrix = Eigen::Matrix<double, Vector::RowsAtCompileTime, Vector::RowsAtCompileTime>;
  constexpr double kIncrement = 1e-8, kLeastIncrement = 1e-11, kRounding = 100.0;
  constexpr int kMostTrials = 500;
  double damping = 1e-2;
  Vector r = residual(y);
  for (int trials = 0; !(r.norm() < tolerance);) {
    Matrix jacobian(r.size(), y.size());
    for (int i = 0; i < y.size(); ++i) {
      const double step = std::max(kIncrement * std::abs(y[i]), kLeastIncrement);
      Vector moved = y;
      moved[i] += step;
      jacobian.col(i) = (residual(moved) - r) / step;
    }
    if (!jacobian.allFinite()) return false;
    const Matrix square = jacobian.transpose() * jacobian;
    const Vector right = -jacobian.transpose() * r;
    Vector trial, r_trial;
    for (damping *= 0.5;; damping *= 2.0) {
      Matrix damped = square;
      damped.diagonal().array() += damping;
      trial = y + damped.llt().solve(right);
      r_trial = residual(trial);
      if (r_trial.norm() < r.norm()) break;
      if (++trials >= kMostTrials || trial == y) return residual(y).norm() < kRounding * tolerance;
    }
    y = trial;
    r = r_trial;
    if (++trials >= kMostTrials) return r.norm() < kRounding * tolerance;
  }
  return true;
}

}  // namespace live_stiffness
