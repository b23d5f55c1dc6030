#include "live_stiffness/analysis/stiffness_matrix.h"

#include <cmath>

#include "lie/matrix6.h"

namespace live_stiffness {
namespace {

constexpr double kLargestCondition = 1e14;

// Factor on angular rows and columns that gives both diagonal blocks the same trace.
double angularFactor(const Matrix6& matrix) {
  return std::sqrt(matrix.topLeftCorner<3, 3>().trace() / matrix.bottomRightCorner<3, 3>().trace());
}

double oneNorm(const Matrix6& a) { return a.cwiseAbs().colwise().sum().maxCoeff(); }

}  // namespace

Matrix6 withAngularScaled(const Matrix6& matrix, double factor) {
  Matrix6 scaled = matrix;
  scaled.rightCols<3>() *= factor;
  scaled.bottomRows<3>() *= factor;
  return scaled;
}

StiffnessMatrix stiffnessOf(const Matrix6& C) {
  StiffnessMatrix result;
  result.condition = kInfinity;
  result.length = angularFactor(C);
  if (!C.allFinite() || !std::isfinite(result.length) || !(result.length > 0.0)) return result;
  const double size = C.topLeftCorner<3, 3>().trace();
  if (!(size > 0.0)) return result;
  const Matrix6 scaled = withAngularScaled(C, result.length) / size;
  const Matrix6 inverse = inverseOf(scaled);
  const double condition = oneNorm(scaled) * oneNorm(inverse);
  if (std::isfinite(condition)) result.condition = condition;
  result.invertible = result.condition <= kLargestCondition;
  if (result.invertible) result.K = withAngularScaled(inverse / size, result.length);
  return result;
}

Matrix6 shiftStiffness(const Matrix6& K, const Vector3& offset) {
  const Matrix6 H_inverse = twistShift(-offset);
  return H_inverse.transpose() * K * H_inverse;
}

double asymmetryOf(const Matrix6& matrix) {
  const double factor = angularFactor(matrix);
  const Matrix6 scaled = std::isfinite(factor) && factor > 0.0 ? withAngularScaled(matrix, factor) : matrix;
  const double symmetric = (scaled + scaled.transpose()).norm();
  return symmetric > 0.0 ? (scaled - scaled.transpose()).norm() / symmetric : 0.0;
}

}  // namespace live_stiffness
