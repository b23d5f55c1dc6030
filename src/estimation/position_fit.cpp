#include "estimation/position_fit.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "lie/matrix6.h"
#include "live_stiffness/estimation/registration_fit.h"

namespace live_stiffness {
namespace {

// Kabsch's method with a small preference for no rotation. It decides where the vectors do not (all parallel, or all zero);
// its effect is far below what the fit corrects afterwards.
Matrix3 startRotation(const Matrix3& sum_of_outer_products) {
  const double scale = sum_of_outer_products.norm();
  return nearestRotation(sum_of_outer_products + (1e-6 * scale + 1e-300) * Matrix3::Identity());
}

// The least-squares problem with p_AB eliminated: everything relative to its mean over the samples.
class CentredProblem {
 public:
  CentredProblem(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS) : X_BT_(X_BT), X_AS_(X_AS) {
    Matrix3 sum_BT = Matrix3::Zero(), sum_AS = Matrix3::Zero();
    double squares = 0.0;
    for (size_t i = 0; i < X_BT.size(); ++i) {
      p_mean_ += X_BT[i].p / count();
      y_mean_ += X_AS[i].p / count();
      sum_BT += X_BT[i].R;
      sum_AS += X_AS[i].R;
      squares += X_BT[i].p.squaredNorm() / count();
    }
    R_mean_ = sum_BT / count();
    rotation_BT_ = nearestRotation(sum_BT);
    rotation_AS_ = nearestRotation(sum_AS);
    lever_ = std::max(std::sqrt(squares), 1e-9);
  }

  Matrix3 startFromPositions() const {
    Matrix3 sum = Matrix3::Zero();
    for (size_t i = 0; i < X_BT_.size(); ++i)
      sum += (X_AS_[i].p - y_mean_) * (X_BT_[i].p - p_mean_).transpose();
    return startRotation(sum);
  }

  Matrix3 startFromOrientations() const {
    Matrix3 sum = Matrix3::Zero();
    for (size_t i = 0; i < X_BT_.size(); ++i)
      sum += logSo3(X_AS_[i].R * rotation_AS_.transpose()) * logSo3(X_BT_[i].R * rotation_BT_.transpose()).transpose();
    return startRotation(sum);
  }

  double cost(const Matrix3& R_AB, const Vector3& offset) const {
    double sum = 0.0;
    for (size_t i = 0; i < X_BT_.size(); ++i) sum += (R_AB * arm(i, offset) - (X_AS_[i].p - y_mean_)).squaredNorm();
    return sum / count();
  }

  // Eigenvalues and vectors of the normal matrix, and gradient, with respect to [lever * turn of R_AB (base side), offset], per
  // sample.
  SymmetricEigen linearize(const Matrix3& R_AB, const Vector3& offset, Vector6& gradient) const {
    Matrix6 normal = Matrix6::Zero();
    gradient.setZero();
    for (size_t i = 0; i < X_BT_.size(); ++i) {
      const Vector3 at = R_AB * arm(i, offset);
      Matrix3X6 J;
      J.leftCols<3>() = hat(at) / -lever_;
      J.rightCols<3>() = R_AB * (X_BT_[i].R - R_mean_);
      normal += J.transpose() * J / count();
      gradient += J.transpose() * (at - (X_AS_[i].p - y_mean_)) / count();
    }
    return eigenOfSymmetric(normal);
  }

  Vector3 basePosition(const Matrix3& R_AB, const Vector3& offset) const {
    return y_mean_ - R_AB * (p_mean_ + R_mean_ * offset);
  }
  double lever() const { return lever_; }

 private:
  double count() const { return static_cast<double>(X_BT_.size()); }
  Vector3 arm(size_t i, const Vector3& offset) const {
    return X_BT_[i].p - p_mean_ + (X_BT_[i].R - R_mean_) * offset;
  }

  const std::vector<Pose>& X_BT_;
  const std::vector<Pose>& X_AS_;
  Vector3 p_mean_ = Vector3::Zero(), y_mean_ = Vector3::Zero();
  Matrix3 R_mean_, rotation_BT_, rotation_AS_;
  double lever_ = 1.0;  // rms distance of the tip from the base, m: makes turns and offsets comparable
};

struct Fit {
  Matrix3 R_AB;
  Vector3 offset;
  double cost = 0.0;
};

// Gauss-Newton along the directions that the data determine, with step halving.
Fit descend(const CentredProblem& problem, const Matrix3& start) {
  constexpr int kMaxIterations = 100;
  Fit best{start, Vector3::Zero(), problem.cost(start, Vector3::Zero())};
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Vector6 gradient;
    const SymmetricEigen eigen = problem.linearize(best.R_AB, best.offset, gradient);
    Vector6 step = Vector6::Zero();
    for (int k = 0; k < 6; ++k) {
      if (eigen.values[k] < kWeakSensitivity * kWeakSensitivity) continue;
      step -= eigen.vectors.col(k) * (eigen.vectors.col(k).dot(gradient) / eigen.values[k]);
    }
    bool better = false;
    for (double factor = 1.0; factor > 1e-3 && !better; factor *= 0.5) {
      Fit next{expSo3(factor / problem.lever() * step.head<3>()) * best.R_AB, best.offset + factor * step.tail<3>()};
      next.cost = problem.cost(next.R_AB, next.offset);
      better = next.cost < best.cost;
      if (better) best = next;
    }
    if (!better || step.norm() < 1e-13) break;
  }
  return best;
}

void markUndetermined(const CentredProblem& problem, const Fit& estimate, PositionFit& fit) {
  Vector6 gradient;
  const SymmetricEigen eigen = problem.linearize(estimate.R_AB, estimate.offset, gradient);
  constexpr double kTakesPart = 0.1;  // smallest component of an undetermined direction that is reported
  fit.weakest_sensitivity = std::sqrt(std::max(eigen.values[0], 0.0));
  fit.base_rotation_determined = fit.sensor_offset_determined = true;
  for (int k = 0; k < 6; ++k) {
    if (eigen.values[k] >= kWeakSensitivity * kWeakSensitivity) continue;
    if (eigen.vectors.col(k).head<3>().norm() > kTakesPart) fit.base_rotation_determined = false;
    if (eigen.vectors.col(k).tail<3>().norm() > kTakesPart) fit.sensor_offset_determined = false;
  }
}

}  // namespace

PositionFit fitPositions(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS, bool start_from_orientations) {
  const CentredProblem problem(X_BT, X_AS);
  Fit best = descend(problem, problem.startFromPositions());
  if (start_from_orientations) {
    // Positions in one plane leave two sides on which the base could be; there orientations decide.
    constexpr double kSame = 1.02;
    const Fit other = descend(problem, problem.startFromOrientations());
    if (other.cost < kSame * best.cost) best = other;
  }
  PositionFit fit;
  fit.X_AB = {best.R_AB, problem.basePosition(best.R_AB, best.offset)};
  fit.offset = best.offset;
  markUndetermined(problem, best, fit);
  for (size_t i = 0; i < X_BT.size(); ++i)
    fit.residuals.push_back((fit.X_AB * (X_BT[i].p + X_BT[i].R * fit.offset) - X_AS[i].p).norm());
  return fit;
}

Matrix3 nearestRotation(const Matrix3& M) {
  const Eigen::JacobiSVD<Matrix3> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 signs = Vector3::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace live_stiffness
