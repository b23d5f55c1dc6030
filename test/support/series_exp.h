#pragma once
// Matrix exponential by its Taylor series in long double: slow, and knows nothing of rotations.

#include <Eigen/Core>

namespace live_stiffness {

// Good to 1e-17 for norms up to about 5, beyond any element or segment in the tests.
template <int n>
Eigen::Matrix<double, n, n> seriesExp(const Eigen::Matrix<double, n, n>& x) {
  using Long = Eigen::Matrix<long double, n, n>;
  const Long x_long = x.template cast<long double>();
  Long term = Long::Identity(), sum = Long::Identity();
  for (int k = 1; k < 80; ++k) {
    term = (term * x_long / k).eval();
    sum += term;
  }
  return sum.template cast<double>();
}

}  // namespace live_stiffness
