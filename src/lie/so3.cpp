#include "live_stiffness/lie/so3.h"

#include <cmath>

namespace live_stiffness {

Matrix3 hat(const Vector3& x) {
  Matrix3 x_hat;
  x_hat << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return x_hat;
}

Matrix3 expSo3(const Vector3& w, double series_below) {
  const double x = w.squaredNorm();
  const Vector3 aw = angleA(x, series_below) * w;
  const Vector3 bw = angleB(x, series_below) * w;
  const double bxx = bw.x() * w.x(), byy = bw.y() * w.y(), bzz = bw.z() * w.z();
  const double bxy = bw.x() * w.y(), bxz = bw.x() * w.z(), byz = bw.y() * w.z();
  Matrix3 R;
  R << 1.0 - byy - bzz, bxy - aw.z(), bxz + aw.y(),
       bxy + aw.z(), 1.0 - bxx - bzz, byz - aw.x(),
       bxz - aw.y(), byz + aw.x(), 1.0 - bxx - byy;
  return R;
}

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

Vector3 bodyRateToVectorRate(const Vector3& w, const Vector3& u, double series_below) {
  const Vector3 w_cross_u = w.cross(u);
  return u + 0.5 * w_cross_u + angleD(w.squaredNorm(), series_below) * w.cross(w_cross_u);
}

Matrix3 orthonormalised(const Matrix3& R) {
  const Matrix3 defect = Matrix3::Identity() - R.transpose() * R;
  return R + 0.5 * R * defect;
}

}  // namespace live_stiffness
