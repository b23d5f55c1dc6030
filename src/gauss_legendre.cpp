#include "gauss_legendre.h"

#include <array>
#include <cmath>

namespace live_stiffness {
namespace {

using Real = long double;
using Nodes = std::array<Real, kMaxNodes>;
constexpr Real kPiLong = 3.14159265358979323846264338327950288L;

// Legendre polynomial P_n at x in [-1, 1], and that of one degree less.
Real legendre(int n, Real x, Real& before) {
  Real now = 1;
  before = 0;
  for (int k = 1; k <= n; ++k) {
    const Real next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
    before = now;
    now = next;
  }
  return now;
}

void makeRule(int n, Nodes& node, Nodes& weight) {
  Real before;
  for (int i = 0; i < n; ++i) {
    Real x = -std::cos(kPiLong * (i + 0.75L) / (n + 0.5L));
    for (int iteration = 0; iteration < 8; ++iteration) {
      const Real value = legendre(n, x, before);
      x -= value * (x * x - 1) / (n * (x * value - before));
    }
    if (n % 2 == 1 && i == n / 2) x = 0;
    const Real slope = n * (x * legendre(n, x, before) - before) / (x * x - 1);
    node[i] = 0.5L * (1 + x);
    weight[i] = 1 / ((1 - x * x) * slope * slope);
  }
}

// Lagrange polynomial that is 1 at node j.
Real lagrange(int n, const Nodes& node, int j, Real at) {
  Real value = 1;
  for (int k = 0; k < n; ++k)
    if (k != j) value *= (at - node[k]) / (node[j] - node[k]);
  return value;
}

// Its integral over [0, end]; its degree is n - 1, so the rule is exact.
Real lagrangeIntegral(int n, const Nodes& node, const Nodes& weight, int j, Real end) {
  Real integral = 0;
  for (int q = 0; q < n; ++q) integral += end * weight[q] * lagrange(n, node, j, end * node[q]);
  return integral;
}

GaussLegendre makeTable(int n) {
  Nodes node{}, weight{};
  makeRule(n, node, weight);
  GaussLegendre table{};
  table.nodes = n;
  for (int j = 0; j < n; ++j) {
    table.c[j] = node[j];
    table.b[j] = weight[j];
    Real before;
    for (int k = 0; k < n; ++k) table.legendre[k][j] = (2 * k + 1) * weight[j] * legendre(k, 2 * node[j] - 1, before);
    for (int i = 0; i < n; ++i) table.a[j][i] = lagrangeIntegral(n, node, weight, j, node[i]);
    if (n < kMaxNodes) table.a[j][n] = weight[j];
  }
  if (n < kMaxNodes) table.c[n] = 1.0;
  return table;
}

}  // namespace

const GaussLegendre& gaussLegendre(int nodes) {
  static const std::array<GaussLegendre, kMaxNodes> tables = [] {
    std::array<GaussLegendre, kMaxNodes> all{};
    for (int n = 1; n <= kMaxNodes; ++n) all[n - 1] = makeTable(n);
    return all;
  }();
  return tables[nodes - 1];
}

NodeTransfer makeTransfer(int from, int to) {
  Nodes node{}, end{}, unused{};
  makeRule(from, node, unused);
  makeRule(to, end, unused);
  NodeTransfer transfer{};
  for (int j = 0; j < from; ++j)
    for (int i = 0; i < to; ++i) {
      // x l_j(x) / c_j, and its derivative.
      const Real x = end[i], value = lagrange(from, node, j, x);
      Real slope = 0;
      for (int m = 0; m < from; ++m) {
        if (m == j) continue;
        Real product = 1 / (node[j] - node[m]);
        for (int k = 0; k < from; ++k)
          if (k != j && k != m) product *= (x - node[k]) / (node[j] - node[k]);
        slope += product;
      }
      transfer.value[j][i] = x * value / node[j];
      transfer.slope[j][i] = (value + x * slope) / node[j];
    }
  return transfer;
}

// As Legendre series:
//   int P_k(xi) dx = (xi^2 - 1) P_k'(xi) / (2 k (k + 1)),  P_{k+1}' = P_{k-1}' + (2 k + 1) P_k,  xi = 2 x - 1.
void integralWeights(int nodes, double x, double* weight) {
  const GaussLegendre& table = gaussLegendre(nodes);
  const double xi = 2.0 * x - 1.0, bubble = 2.0 * x * (x - 1.0);
  double before = 1.0, now = xi, slope_before = 0.0, slope = 1.0;
  for (int j = 0; j < nodes; ++j) weight[j] = x * table.legendre[0][j];
  for (int k = 1; k < nodes; ++k) {
    const double integral = bubble * slope / (k * (k + 1));
    for (int j = 0; j < nodes; ++j) weight[j] += integral * table.legendre[k][j];
    const double next_slope = slope_before + (2 * k + 1) * now;
    const double next = ((2 * k + 1) * xi * now - k * before) / (k + 1);
    slope_before = slope, slope = next_slope;
    before = now, now = next;
  }
}

}  // namespace live_stiffness
