#include "calibration/calibration_costs.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

int rotationResiduals(const RecordingEvaluator& evaluator, const ResidualSigmas& sigmas) {
  if (!(sigmas.rotation > 0.0) || evaluator.measures() == TrackerMeasures::kPosition) return 0;
  return evaluator.measures() == TrackerMeasures::kPose ? 3 : 2;
}

}  // namespace

Tilt tiltBetween(const Vector3& from, const Vector3& to) {
  const Vector3 normal = from.cross(to);  // length sin(angle)
  const double cosine = from.dot(to), sine = normal.norm(), angle = std::atan2(sine, cosine);
  // vector = f normal, f = angle / sine; df / dcosine is -1/3 at 0. Opposite axes have no smallest rotation.
  const bool small = sine < 1e-4 && cosine > 0.0;
  const double f = small ? 1.0 + sine * sine / 6.0 : angle / std::max(sine, 1e-9);
  const double slope = small ? -1.0 / 3.0 : (f * cosine - 1.0) / std::max(sine * sine, 1e-18);
  return {f * normal, f * (cosine * Matrix3::Identity() - to * from.transpose()) - slope * normal * normal.transpose()};
}

SampleCost::SampleCost(RecordingEvaluator& evaluator, size_t sample, const std::vector<SceneParameter>& parameters,
                       const ResidualSigmas& sigmas)
    : evaluator_(evaluator), sample_(sample), parameters_(parameters), sigmas_(sigmas) {
  set_num_residuals(3 + rotationResiduals(evaluator, sigmas));
  if (!parameters.empty()) mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
  mutable_parameter_block_sizes()->push_back(kRegistrationSize);
}

bool SampleCost::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  const int own = parameters_.empty() ? 0 : 1;  // index of the registration's block
  const bool derivatives = own == 1 && jacobians != nullptr && jacobians[0] != nullptr;
  const TipPredictions* predictions = evaluator_.at(own == 1 ? blocks[0] : nullptr, derivatives);
  if (predictions == nullptr) return false;
  const Pose& X_BT = predictions->X_BT[sample_];
  const RecordedSample& measured = evaluator_.data().recording.samples[sample_];
  const Eigen::Map<const RegistrationVector> r(blocks[own]);
  const Registration registration = evaluator_.registration(r);
  const Matrix3& R_AB = registration.X_AB.R;
  const Matrix3 R_AT = R_AB * X_BT.R;
  const Pose sensor = registration.sensorPose(X_BT);
  const Pose X_AS = measured.tipPose();
  const int rows = num_residuals(), turns = rows - 3;
  // Rotation error (rad) and its derivative by a small rotation of the predicted sensor, A axes.
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> turn(turns);
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> by_rotation(turns, 3);
  if (turns == 3) {
    const Vector3 error = angular(residualTwist(sensor, X_AS));
    turn = error;
    for (int k = 0; k < 3; ++k) by_rotation.col(k) = bodyRateToVectorRate(-error, Vector3::Unit(k));
  } else if (turns == 2) {
    const Tilt tilt = tiltBetween(X_AS.R.col(2), sensor.R.col(2));
    turn = (X_AS.R.transpose() * tilt.vector).head<2>();
    by_rotation = (X_AS.R.transpose() * tilt.derivative).topRows<2>();
  }
  Vector6 weights;  // the last ones are not used where fewer rotations are measured
  weights << Vector3::Constant(1.0 / sigmas_.position), Vector3::Constant(1.0 / sigmas_.rotation);
  Eigen::Map<Eigen::VectorXd> errors(residuals, rows);
  errors << sensor.p - X_AS.p, turn;
  errors = weights.head(rows).cwiseProduct(errors).eval();
  if (jacobians == nullptr) return true;
  if (jacobians[own] != nullptr) {
    const Matrix3 dexp = leftJacobianSo3(Vector3(r.head<3>()));
    Eigen::Map<RowMajor> J(jacobians[own], rows, kRegistrationSize);
    J.setZero();
    J.block<3, 3>(0, 0) = -hat(sensor.p - registration.X_AB.p) * dexp;
    J.block<3, 3>(0, 3).setIdentity();
    J.block<3, 3>(0, 6) = R_AT;
    J.block(3, 0, turns, 3) = by_rotation * dexp;
    J.block(3, 9, turns, 3) = by_rotation * R_AT * leftJacobianSo3(Vector3(r.tail<3>()));
    J = weights.head(rows).asDiagonal() * J.eval();
  }
  if (!derivatives) return true;
  Eigen::Map<RowMajor> J(jacobians[0], rows, static_cast<long>(parameters_.size()));
  const Vector3 lever = X_BT.R * registration.X_TS.p;
  for (size_t k = 0; k < parameters_.size(); ++k) {
    const auto column = static_cast<long>(k);
    const Twist twist = predictions->derivative[sample_].col(column) * parameters_[k].prior_sigma;
    J.col(column).head<3>() = R_AB * (linear(twist) + angular(twist).cross(lever));
    J.col(column).tail(turns) = by_rotation * (R_AB * angular(twist));
    J.col(column) = weights.head(rows).cwiseProduct(J.col(column)).eval();
  }
  return true;
}

ComplianceCost::ComplianceCost(RowCompliance compliance, const Matrix3& measured, double sigma,
                               const std::vector<SceneParameter>& parameters)
    : compliance_(std::move(compliance)), measured_(measured), scale_(1.0 / (sigma * measured.norm())),
      parameters_(parameters) {
  set_num_residuals(10);
  mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
}

bool ComplianceCost::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  const Eigen::VectorXd values = valuesAt(parameters_, blocks[0]);
  Errors errors, below;
  if (!evaluate(values, errors)) return false;
  std::copy_n(errors.data(), errors.size(), residuals);
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  Eigen::Map<RowMajor> J(jacobians[0], 10, values.size());
  J.setZero();
  for (size_t k = 0; k < parameters_.size(); ++k) {
    const ParameterStep step = stepAbout(values, parameters_, k);
    if (!(step.distance() > 0.0)) continue;
    if (!evaluate(step.above, errors) || !evaluate(step.below, below)) return false;
    J.col(static_cast<long>(k)) = (errors - below) * (parameters_[k].prior_sigma / step.distance());
  }
  return true;
}

bool ComplianceCost::evaluate(const Eigen::VectorXd& values, Errors& errors) const {
  Matrix3 C;
  if (!compliance_(values, C)) return false;
  errors << scale_ * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(Matrix3(C - measured_).data()),
      scale_ * (C.norm() - measured_.norm());
  return true;
}

}  // namespace live_stiffness
