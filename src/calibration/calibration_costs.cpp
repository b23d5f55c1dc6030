#include "calibration/calibration_costs.h"

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
    const std::vector<TipPrediction>* predictions = evaluator_.at(own == 1 ? blocks[0] : nullptr, derivatives);
    if (predictions == nullptr) return false;
    const TipPrediction& prediction = (*predictions)[sample_];
    const RecordedSample& measured = evaluator_.data().recording.samples[sample_];
    const Eigen::Map<const RegistrationVector> r(blocks[own]);
    const Registration registration = evaluator_.registration(r);
    const Matrix3 R_AT = registration.X_AB.R * prediction.X_BT.R;
    const Vector3 arm = registration.X_AB.R * (prediction.X_BT.p + prediction.X_BT.R * registration.X_TS.p);
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
    const Vector3 lever = prediction.X_BT.R * registration.X_TS.p;
    for (size_t k = 0; k < parameters_.size(); ++k) {
      const Vector6 twist = prediction.derivative.col(static_cast<long>(k)) * parameters_[k].prior_sigma;
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

// Derivatives by central differences of solves to 1e-12. A table has few rows, so this costs less than a millisecond.
class ComplianceCost : public ceres::CostFunction {
 public:
  ComplianceCost(RowCompliance compliance, const Matrix3& measured, double sigma, int parameters)
      : compliance_(std::move(compliance)), measured_(measured), scale_(1.0 / (sigma * measured.norm())) {
    set_num_residuals(10);
    mutable_parameter_block_sizes()->push_back(parameters);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const int count = parameter_block_sizes()[0];
    if (!evaluate(blocks[0], residuals)) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    constexpr double kStep = 1e-4;  // of a prior sigma: truncation 1e-8 of the change, rounding 1e-8 too
    std::vector<double> x(blocks[0], blocks[0] + count);
    double above[10], below[10];
    for (int k = 0; k < count; ++k) {
      const double at = x[k];
      x[k] = at + kStep;
      if (!evaluate(x.data(), above)) return false;
      x[k] = at - kStep;
      if (!evaluate(x.data(), below)) return false;
      x[k] = at;
      for (int i = 0; i < 10; ++i) jacobians[0][i * count + k] = (above[i] - below[i]) / (2.0 * kStep);
    }
    return true;
  }

 private:
  bool evaluate(const double* x, double* residuals) const {
    Matrix3 C;
    if (!compliance_(x, C)) return false;
    Eigen::Map<Matrix3> entries(residuals);
    entries = scale_ * (C - measured_);
    residuals[9] = scale_ * (C.norm() - measured_.norm());
    return true;
  }

  RowCompliance compliance_;
  Matrix3 measured_;
  double scale_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> sampleCost(RecordingEvaluator& evaluator, size_t sample,
                                                const std::vector<SceneParameter>& parameters,
                                                const ResidualSigmas& sigmas) {
  return std::make_unique<SampleCost>(evaluator, sample, parameters, sigmas);
}

std::unique_ptr<ceres::CostFunction> complianceCost(RowCompliance compliance, const Matrix3& measured, double sigma,
                                                    int parameters) {
  return std::make_unique<ComplianceCost>(std::move(compliance), measured, sigma, parameters);
}

}  // namespace live_stiffness
