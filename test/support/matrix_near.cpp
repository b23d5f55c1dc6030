#include "support/matrix_near.h"

#include <iomanip>

namespace live_stiffness {

::testing::AssertionResult matrixNear(const MatrixRef& actual, const MatrixRef& expected, double tolerance) {
  auto failure = ::testing::AssertionFailure();
  failure << std::setprecision(17);
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols())
    return failure << "shapes differ: actual " << actual.rows() << "x" << actual.cols() << ", expected "
                   << expected.rows() << "x" << expected.cols();
  const Eigen::MatrixXd difference = actual - expected;
  const bool finite = actual.allFinite() && expected.allFinite();
  Eigen::Index row = 0, column = 0;
  const double worst = finite ? difference.cwiseAbs().maxCoeff(&row, &column) : 0.0;
  if (finite && worst <= tolerance) return ::testing::AssertionSuccess();
  if (!finite) failure << "holds NaN or infinity (" << (actual.allFinite() ? "expected" : "actual") << ")";
  else failure << "worst at (" << row << ", " << column << "): " << worst << " > " << tolerance;
  return failure << "\nactual\n" << actual << "\nexpected\n" << expected << "\ndifference\n" << difference;
}

}  // namespace live_stiffness
