#include "live_stiffness/gauss_legendre.h"

#include <cmath>

#include "live_stiffness/conventions.h"

namespace live_stiffness {
namespace {

using Real = long double;

// Legendre polynomial P_n and its derivative at x in (-1, 1).
void legendre(int n, Real x, Real& value, Real& derivative) {
  Real before = 1, now = x;
  for (int k = 2; k <= n; ++k) {
    const Real next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
    before = now;
    now = next;
  }
  value = now;
  derivative = n * (x * now - before) / (x * x - 1);
}

GaussLegendre makeTable() {
  constexpr int n = kStages;
  std::array<Real, n> node, weight;
  for (int i = 0; i < n; ++i) {
    Real x = -std::cos(static_cast<Real>(kPi) * (i + 0.75L) / (n + 0.5L));
    Real value, derivative;
    for (int iteration = 0; iteration < 8; ++iteration) {
      legendre(n, x, value, derivative);
      x -= value / derivative;
    }
    legendre(n, x, value, derivative);
    node[i] = 0.5L * (1 + x);
    weight[i] = 1 / ((1 - x * x) * derivative * derivative);
  }
  GaussLegendre table;
  for (int i = 0; i < n; ++i) {
    table.c[i] = node[i];
    table.b[i] = weight[i];
    Real value, derivative;
    legendre(n - 1, 2 * node[i] - 1, value, derivative);
    table.top[i] = (2 * n - 1) * weight[i] * value;
    legendre(n - 2, 2 * node[i] - 1, value, derivative);
    table.below_top[i] = (2 * n - 3) * weight[i] * value;
    // a_ij: the Lagrange polynomial of node j has degree n - 1, so the rule itself integrates it exactly.
    for (int j = 0; j < n; ++j) {
      Real integral = 0;
      for (int q = 0; q < n; ++q) {
        Real lagrange = 1;
        for (int k = 0; k < n; ++k)
          if (k != j) lagrange *= (node[i] * node[q] - node[k]) / (node[j] - node[k]);
        integral += node[i] * weight[q] * lagrange;
      }
      table.a[i][j] = integral;
    }
  }
  return table;
}

}  // namespace

const GaussLegendre& gaussLegendre() {
  static const GaussLegendre table = makeTable();
  return table;
}

}  // namespace live_stiffness
