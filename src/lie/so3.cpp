#include "live_stiffness/lie/so3.h"

#include <cmath>

namespace live_stiffness {

Vector3 logSo3(const Matrix3& R, double linear_below) {
  Eigen::Quaterniond q(R);  // stable near both 0 and pi
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();  // of half the angle
  if (sine < linear_below) return 2.0 / q.w() * q.vec();  // the next term is sine^2 / 3 relative, 3e-17 at 1e-8
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

Matrix3 leftJacobianSo3(const Vector3& w, double series_below) {
  const double x = w.squaredNorm();
  const Matrix3 w_hat = hat(w);
  return Matrix3::Identity() + angleB(x, series_below) * w_hat + angleC(x, series_below) * w_hat * w_hat;
}

}  // namespace live_stiffness
