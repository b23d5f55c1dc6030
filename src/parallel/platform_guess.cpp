#include "parallel/platform_guess.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "gauss_legendre.h"

namespace live_stiffness {
namespace {

// [v; w] moves the platform; scale: metres that have the same weight as one radian.
Pose moved(const Pose& X, const Vector6& by, double scale) {
  return {expSo3(by.tail<3>() / scale) * X.R, X.p + by.head<3>()};
}

double squaredMisfit(const ParallelScene& scene, const std::vector<double>& lengths, const Pose& X) {
  double sum = 0.0;
  for (size_t i = 0; i < lengths.size(); ++i) sum += std::pow(lengthOfCurve(scene.rods[i], X) - lengths[i], 2);
  return sum;
}

}  // namespace

double lengthOfCurve(const ParallelRod& rod, const Pose& X_BP) {
  const Pose end = X_BP * rod.X_PE;
  const Vector3 chord = end.p - rod.X_BD.p;
  const Vector3 a = chord.norm() * rod.X_BD.R.col(2), b = chord.norm() * end.R.col(2);
  const GaussLegendre& table = gaussLegendre(6);
  double length = 0.0;
  for (int i = 0; i < table.nodes; ++i) {
    const double x = table.c[i];
    const Vector3 rate = 6.0 * x * (1.0 - x) * chord + (1.0 - x) * (1.0 - 3.0 * x) * a + x * (3.0 * x - 2.0) * b;
    length += table.b[i] * rate.norm();
  }
  return length;
}

Pose guessPlatformPose(const ParallelScene& scene, const std::vector<double>& lengths) {
  Pose X;
  double scale = 0.0;
  for (size_t i = 0; i < lengths.size(); ++i) {
    const ParallelRod& rod = scene.rods[i];
    X.p += (rod.X_BD * (lengths[i] * Vector3::UnitZ()) - rod.X_PE.p) / lengths.size();
    scale += 0.3 * lengths[i] / lengths.size();
  }
  double damping = 1e-3, misfit = squaredMisfit(scene, lengths, X);
  for (int iteration = 0; iteration < 60 && misfit > 1e-16 * scale * scale; ++iteration) {
    Matrix6 normal = damping * Matrix6::Identity();
    Vector6 gradient = Vector6::Zero();
    const double h = 1e-6 * scale;
    for (size_t i = 0; i < lengths.size(); ++i) {
      Vector6 slope;
      for (int k = 0; k < 6; ++k)
        slope[k] = (lengthOfCurve(scene.rods[i], moved(X, h * Vector6::Unit(k), scale)) -
                    lengthOfCurve(scene.rods[i], moved(X, -h * Vector6::Unit(k), scale))) / (2.0 * h);
      normal += slope * slope.transpose();
      gradient += slope * (lengthOfCurve(scene.rods[i], X) - lengths[i]);
    }
    Vector6 step = -normal.ldlt().solve(gradient);
    step *= std::min(1.0, 0.5 * scale / (step.norm() + 1e-300));
    const Pose trial = moved(X, step, scale);
    const double trial_misfit = squaredMisfit(scene, lengths, trial);
    if (trial_misfit < misfit) {
      X = trial;
      misfit = trial_misfit;
      damping = std::max(0.2 * damping, 1e-9);
    } else {
      damping *= 10.0;
      if (damping > 1e6) break;
    }
  }
  return X;
}

}  // namespace live_stiffness
