#include "calibration/calibration_costs.h"

#include <algorithm>

namespace live_stiffness {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

SampleCost::SampleCost(RecordingEvaluator& evaluator, size_t sample, const std::vector<SceneParameter>& parameters,
                       const ResidualSigmas& sigmas)
    : evaluator_(evaluator), sample_(sample), parameters_(parameters), sigmas_(sigmas) {
  set_num_residuals(sigmas.rotation > 0.0 ? 6 : 3);
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
  const Twist error = residualTwist(sensor, measured.tipPose());
  const int rows = num_residuals();
  Vector6 weights;  // the last three are not used without a rotation sigma
  weights << Vector3::Constant(1.0 / sigmas_.position), Vector3::Constant(1.0 / sigmas_.rotation);
  Eigen::Map<Eigen::VectorXd>(residuals, rows) = weights.head(rows).cwiseProduct(error.head(rows));
  if (jacobians == nullptr) return true;
  const Vector3 turn = angular(error);
  Matrix3 left_inverse;
  for (int k = 0; k < 3; ++k) left_inverse.col(k) = bodyRateToVectorRate(-turn, Vector3::Unit(k));
  if (jacobians[own] != nullptr) {
    const Matrix3 dexp = leftJacobianSo3(Vector3(r.head<3>()));
    Eigen::Matrix<double, 6, kRegistrationSize> J = Eigen::Matrix<double, 6, kRegistrationSize>::Zero();
    J.block<3, 3>(0, 0) = -hat(sensor.p - registration.X_AB.p) * dexp;
    J.block<3, 3>(0, 3).setIdentity();
    J.block<3, 3>(0, 6) = R_AT;
    J.block<3, 3>(3, 0) = left_inverse * dexp;
    J.block<3, 3>(3, 9) = left_inverse * R_AT * leftJacobianSo3(Vector3(r.tail<3>()));
    Eigen::Map<RowMajor>(jacobians[own], rows, kRegistrationSize) = weights.head(rows).asDiagonal() * J.topRows(rows);
  }
  if (!derivatives) return true;
  Eigen::Map<RowMajor> J(jacobians[0], rows, static_cast<long>(parameters_.size()));
  const Vector3 lever = X_BT.R * registration.X_TS.p;
  for (size_t k = 0; k < parameters_.size(); ++k) {
    const auto column = static_cast<long>(k);
    const Twist twist = predictions->derivative[sample_].col(column) * parameters_[k].prior_sigma;
    Twist of_sensor;
    of_sensor << R_AB * (linear(twist) + angular(twist).cross(lever)), left_inverse * (R_AB * angular(twist));
    J.col(column) = weights.head(rows).cwiseProduct(of_sensor.head(rows));
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
