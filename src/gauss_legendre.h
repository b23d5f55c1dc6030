#pragma once
// Gauss-Legendre nodes on [0, 1], for quadrature and for collocation. Plain data, so that code compiled for another
// instruction set may read it.

namespace live_stiffness {

constexpr int kMaxNodes = 12;
typedef double NodeRow[kMaxNodes] __attribute__((aligned(32)));  // one value per node, the rest zero

// For n nodes: quadrature is exact to degree 2 n - 1, collocation has order 2 n.
struct GaussLegendre {
  NodeRow c;                    // nodes; c[n] = 1 is the end
  NodeRow b;                    // weights, sum 1
  NodeRow a[kMaxNodes];         // a[j][i] integrates over [0, c_i]: transposed Runge-Kutta matrix of Gauss; a[j][n] = b_j
  NodeRow legendre[kMaxNodes];  // sum_j legendre[k][j] f(c_j): coefficient of f at P_k(2 x - 1), k < n
  int nodes;
};

// The table for 1 to kMaxNodes nodes, computed at first use in extended precision.
const GaussLegendre& gaussLegendre(int nodes);

// Of the polynomial that is zero at 0 and given at the nodes c_j of `from`: value[j][i] and slope[j][i] at c_i of `to`.
struct NodeTransfer {
  NodeRow value[kMaxNodes], slope[kMaxNodes];
};
NodeTransfer makeTransfer(int from, int to);

// Weights, as many as nodes (1 to kMaxNodes), of the values at the nodes in the integral from 0 to x (0 to 1) of the
// polynomial through them; exactly nothing at 0.
void integralWeights(int nodes, double x, double* weight);

}  // namespace live_stiffness
