#pragma once
// Residuals of a calibration: of its samples, and of the rows of compliance tables.

#include <ceres/cost_function.h>

#include <functional>
#include <vector>

#include "calibration/recording_evaluator.h"

namespace live_stiffness {

struct ResidualSigmas {
  double position, rotation;  // m, rad; rotation 0: orientations are not used
};

// Smallest rotation (rotation vector, rad) that takes the axis `from` to `to`, unit vectors, and its derivative by a small
// rotation of `to`.
struct Tilt {
  Vector3 vector;
  Matrix3 derivative;
};
Tilt tiltBetween(const Vector3& from, const Vector3& to);

// One sample: position and, with a rotation sigma, orientation of the sensor in the tracker's frame, in sigmas; of a tracker that
// measures only the sensor's z axis, the tilt of that about the measured x and y axes. Blocks: the parameters, unless there are
// none, and the recording's registration. Refers to evaluator and parameters.
class SampleCost : public ceres::CostFunction {
 public:
  SampleCost(RecordingEvaluator& evaluator, size_t sample, const std::vector<SceneParameter>& parameters,
             const ResidualSigmas& sigmas);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  RecordingEvaluator& evaluator_;
  size_t sample_;
  const std::vector<SceneParameter>& parameters_;
  ResidualSigmas sigmas_;
};

// Compliance of a row at these values (SI) of the parameters, m/N. False if there is no solution.
using RowCompliance = std::function<bool(const Eigen::VectorXd& values, Matrix3& compliance)>;

// Errors of the row's nine entries and of its norm, which (42) compares, divided by `sigma` times the measured norm. Block: x.
// Refers to parameters.
class ComplianceCost : public ceres::CostFunction {
 public:
  ComplianceCost(RowCompliance compliance, const Matrix3& measured, double sigma,
                 const std::vector<SceneParameter>& parameters);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  using Errors = Eigen::Matrix<double, 10, 1>;
  bool evaluate(const Eigen::VectorXd& values, Errors& errors) const;

  RowCompliance compliance_;
  Matrix3 measured_;
  double scale_;
  const std::vector<SceneParameter>& parameters_;
};

}  // namespace live_stiffness
