#include "calibration/calibration_costs.h"

#include <algorithm>
#include <vector>

namespace live_stiffness {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class SampleCost : public ceres::CostFunction {
 public:
  SampleCost(RecordingEvaluator& evaluator, size_t sample, const std::vector<SceneParameter>& parameters,
             ResidualSigmas sigmas)
      : evaluator_(evaluator), sample_(sample), parameters_(parameters), sigmas_(sigmas) {
    set_num_residuals(sigmas.rotation > 0.0 ? 6 : 3);
    if (!parameters.empty()) mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
    mutable_parameter_block_sizes()->push_back(kRegistrationSize);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const int own = parameters_.empty() ? 0 : 1;  // index of the registration's block
    const bool derivatives = own == 1 && jacobians != nullptr && jacobians[0] != nullptr;
    const TipPredictions* predictions = evaluator_.at(own == 1 ? blocks[0] : nullptr, derivatives);
    if (predictions == nullptr) return false;
    const Pose& X_BT = predictions->X_BT[sample_];
    const RecordedSample& measured = evaluator_.data().recording.samples[sample_];
    const Eigen::Map<const RegistrationVector> r(blocks[own]);
    const Registration registration = evaluator_.registration(r);
    const Matrix3 R_AT = registration.X_AB.R * X_BT.R;
    const Vector3 arm = registration.X_AB.R * (X_BT.p + X_BT.R * registration.X_TS.p);
    const Vector3 position = arm + registration.X_AB.p - measured.tip_position;
    const int rows = num_residuals();
    Eigen::Map<Eigen::VectorXd> e(residuals, rows);
    e.head<3>() = position / sigmas_.position;
    Matrix3 left_inverse = Matrix3::Identity();
    if (rows == 6) {
      const Vector3 turn = logSo3(R_AT * registration.X_TS.R * measured.tipPose().R.transpose());
      e.tail<3>() = turn / sigmas_.rotation;
      for (int k = 0; k < 3; ++k) left_inverse.col(k) = bodyRateToVectorRate(-turn, Vector3::Unit(k));
    }
    if (jacobians == nullptr) return true;
    if (jacobians[own] != nullptr) {
      Eigen::Map<RowMajor> J(jacobians[own], rows, kRegistrationSize);
      J.setZero();
      const Matrix3 dexp = leftJacobianSo3(Vector3(r.head<3>()));
      J.block<3, 3>(0, 0) = -hat(arm) * dexp / sigmas_.position;
      J.block<3, 3>(0, 3) = Matrix3::Identity() / sigmas_.position;
      J.block<3, 3>(0, 6) = R_AT / sigmas_.position;
      if (rows == 6) {
        J.block<3, 3>(3, 0) = left_inverse * dexp / sigmas_.rotation;
        J.block<3, 3>(3, 9) = left_inverse * R_AT * leftJacobianSo3(Vector3(r.tail<3>())) / sigmas_.rotation;
      }
    }
    if (!derivatives) return true;
    Eigen::Map<RowMajor> J(jacobians[0], rows, static_cast<long>(parameters_.size()));
    const Matrix3& R_AB = registration.X_AB.R;
    const Vector3 lever = X_BT.R * registration.X_TS.p;
    for (size_t k = 0; k < parameters_.size(); ++k) {
      const Vector6 twist = predictions->derivative[sample_].col(static_cast<long>(k)) * parameters_[k].prior_sigma;
      const long column = static_cast<long>(k);
      J.block<3, 1>(0, column) = R_AB * (twist.head<3>() + twist.tail<3>().cross(lever)) / sigmas_.position;
      if (rows == 6) J.block<3, 1>(3, column) = left_inverse * (R_AB * twist.tail<3>()) / sigmas_.rotation;
    }
    return true;
  }

 private:
  RecordingEvaluator& evaluator_;
  size_t sample_;
  const std::vector<SceneParameter>& parameters_;
  ResidualSigmas sigmas_;
};

class ComplianceCost : public ceres::CostFunction {
 public:
  ComplianceCost(RowCompliance compliance, const Matrix3& measured, double sigma,
                 const std::vector<SceneParameter>& parameters)
      : compliance_(std::move(compliance)), measured_(measured), scale_(1.0 / (sigma * measured.norm())),
        parameters_(parameters) {
    set_num_residuals(10);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Eigen::VectorXd values = valuesAt(parameters_, blocks[0]);
    Errors errors, below;
    if (!evaluate(values, errors)) return false;
    std::copy_n(errors.data(), errors.size(), residuals);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<RowMajor> J(jacobians[0], 10, values.size());
    J.setZero();
    for (size_t k = 0; k < parameters_.size(); ++k) {
      const ParameterStep step = stepAbout(values, parameters_, k);
      if (!(step.distance > 0.0)) continue;
      if (!evaluate(step.above, errors) || !evaluate(step.below, below)) return false;
      J.col(static_cast<long>(k)) = (errors - below) * (parameters_[k].prior_sigma / step.distance);
    }
    return true;
  }

 private:
  using Errors = Eigen::Matrix<double, 10, 1>;

  bool evaluate(const Eigen::VectorXd& values, Errors& errors) const {
    Matrix3 C;
    if (!compliance_(values, C)) return false;
    errors << scale_ * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(Matrix3(C - measured_).data()),
        scale_ * (C.norm() - measured_.norm());
    return true;
  }

  RowCompliance compliance_;
  Matrix3 measured_;
  double scale_;
  const std::vector<SceneParameter>& parameters_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> sampleCost(RecordingEvaluator& evaluator, size_t sample,
                                                const std::vector<SceneParameter>& parameters,
                                                const ResidualSigmas& sigmas) {
  return std::make_unique<SampleCost>(evaluator, sample, parameters, sigmas);
}

std::unique_ptr<ceres::CostFunction> complianceCost(RowCompliance compliance, const Matrix3& measured, double sigma,
                                                    const std::vector<SceneParameter>& parameters) {
  return std::make_unique<ComplianceCost>(std::move(compliance), measured, sigma, parameters);
}

}  // namespace live_stiffness
