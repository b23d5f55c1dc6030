#include "live_stiffness/gauss_legendre.h"

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

// Integral over [0, end] of the Lagrange polynomial that is 1 at node j. Its degree is n - 1, so the rule is exact.
Real lagrangeIntegral(int n, const Nodes& node, const Nodes& weight, int j, Real end) {
  Real integral = 0;
  for (int q = 0; q < n; ++q) {
    Real lagrange = 1;
    for (int k = 0; k < n; ++k)
      if (k != j) lagrange *= (end * node[q] - node[k]) / (node[j] - node[k]);
    integral += end * weight[q] * lagrange;
  }
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
  Nodes node{}, weight{}, end{}, unused{};
  makeRule(from, node, weight);
  makeRule(to, end, unused);
  NodeTransfer transfer{};
  for (int j = 0; j < from; ++j)
    for (int i = 0; i < to; ++i) transfer.integral[j][i] = lagrangeIntegral(from, node, weight, j, end[i]);
  return transfer;
}

}  // namespace live_stiffness
