#pragma once
// Symmetric matrices of 3x3 blocks that couple neighbours only, as a chain of nodes has them. Node 0 is held: it has no row.

#include <Eigen/Cholesky>

#include <algorithm>
#include <vector>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

template <int columns>
using NodeBlocks = std::vector<Eigen::Matrix<double, 3, columns>>;  // one for each node
using NodeVectors = NodeBlocks<1>;

inline double dot(const NodeVectors& a, const NodeVectors& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

inline double largestNorm(const NodeVectors& a) {
  double largest = 0.0;
  for (const Vector3& x : a) largest = std::max(largest, x.norm());
  return largest;
}

inline NodeVectors scaled(double factor, NodeVectors a) {
  for (Vector3& x : a) x *= factor;
  return a;
}

struct BlockTridiagonal {
  NodeBlocks<3> diagonal, below;  // below[i]: row i + 1, column i

  explicit BlockTridiagonal(size_t nodes) : diagonal(nodes, Matrix3::Zero()), below(nodes, Matrix3::Zero()) {}

  BlockTridiagonal plus(double factor, const BlockTridiagonal& other) const {
    BlockTridiagonal sum = *this;
    for (size_t i = 0; i < diagonal.size(); ++i) {
      sum.diagonal[i] += factor * other.diagonal[i];
      sum.below[i] += factor * other.below[i];
    }
    return sum;
  }

  NodeVectors times(const NodeVectors& x) const {
    NodeVectors y(x.size(), Vector3::Zero());
    for (size_t i = 1; i < x.size(); ++i) {
      y[i] += diagonal[i] * x[i];
      if (i > 1) y[i] += below[i - 1] * x[i - 1];
      if (i + 1 < x.size()) y[i] += below[i].transpose() * x[i + 1];
    }
    return y;
  }
};

// Cholesky, block by block.
class BlockCholesky {
 public:
  explicit BlockCholesky(const BlockTridiagonal& a) : below_(a.below), pivots_(a.diagonal.size()) {
    for (size_t i = 1; i < pivots_.size() && is_positive_; ++i) {
      Matrix3 pivot = a.diagonal[i];
      if (i > 1) pivot -= below_[i - 1] * pivots_[i - 1].solve(below_[i - 1].transpose());
      pivots_[i].compute(pivot);
      is_positive_ = pivots_[i].info() == Eigen::Success;
    }
  }

  bool isPositive() const { return is_positive_; }  // all eigenvalues; if not, there is nothing to solve with

  template <int columns>
  NodeBlocks<columns> solve(NodeBlocks<columns> x) const {
    x[0].setZero();
    for (size_t i = 2; i < x.size(); ++i) x[i] -= below_[i - 1] * pivots_[i - 1].solve(x[i - 1]);
    for (size_t i = x.size() - 1; i >= 1; --i) {
      if (i + 1 < x.size()) x[i] -= below_[i].transpose() * x[i + 1];
      x[i] = pivots_[i].solve(x[i]).eval();
    }
    return x;
  }

 private:
  NodeBlocks<3> below_;
  std::vector<Eigen::LLT<Matrix3>> pivots_;
  bool is_positive_ = true;
};

}  // namespace live_stiffness
