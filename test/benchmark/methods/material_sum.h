#pragma once
// Quadrature of the material compliance (10) along a rod, section by section: C about the base origin, then about T.

#include "live_stiffness/lie/se3.h"
#include "live_stiffness/section/cross_section.h"
#include "section/section_moments.h"

namespace live_stiffness {

class MaterialSum {
 public:
  // Adds weight (m) times dC/ds at a section in pose X.
  void add(const Pose& X, const ComplianceDensity& c, double weight) {
    const Matrix3 B = X.R * (weight * c.bending_torsion) * X.R.transpose();
    const Matrix3 p_hat = hat(X.p);
    const Matrix3 p_hat_B = p_hat * B;
    force_.noalias() += X.R * (weight * c.shear_elongation) * X.R.transpose() - p_hat_B * p_hat;
    mixed_ += p_hat_B;
    moment_ += B;
  }

  Matrix6 about(const Vector3& p_BT) const {
    Matrix6 C;
    C << force_, mixed_, mixed_.transpose(), moment_;
    return shiftCompliance(C, p_BT);
  }

 private:
  Matrix3 force_ = Matrix3::Zero(), mixed_ = Matrix3::Zero(), moment_ = Matrix3::Zero();
};

// Weight of node i of N + 1 equidistant ones (N even) by Simpson's rule, over the length.
inline double simpsonWeight(int i, int N) {
  if (i == 0 || i == N) return 1.0 / (3.0 * N);
  return (i % 2 == 1 ? 4.0 : 2.0) / (3.0 * N);
}

}  // namespace live_stiffness
