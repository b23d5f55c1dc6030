#pragma once
// The one matrix assertion of the tests: EXPECT_TRUE(matrixNear(actual, expected, tolerance)).

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace live_stiffness {

using MatrixRef = Eigen::Ref<const Eigen::MatrixXd>;

// Success if the shapes agree, nothing is NaN, and no element differs by more than `tolerance`. A failure prints the
// shapes, both matrices, their difference and the worst element. Vectors are matrices of one column.
::testing::AssertionResult matrixNear(const MatrixRef& actual, const MatrixRef& expected, double tolerance);

}  // namespace live_stiffness
