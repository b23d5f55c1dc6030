#pragma once
// Gauss-Legendre nodes on [0, 1], for quadrature and for collocation.

#include <array>

namespace live_stiffness {

constexpr int kStages = 6;  // quadrature exact to degree 11, collocation of order 12

// c: nodes; b: weights, sum 1; a: a[i][j] integrates over [0, c_i] (the Runge-Kutta matrix of the Gauss method);
// top: sum_i top[i] f(c_i) is the Legendre coefficient of f of the highest degree that kStages nodes can see;
// below_top: that of one degree less.
struct GaussLegendre {
  std::array<double, kStages> c, b, top, below_top;
  std::array<std::array<double, kStages>, kStages> a;
};

// The one table, computed at first use.
const GaussLegendre& gaussLegendre();

}  // namespace live_stiffness
