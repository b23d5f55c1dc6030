#include "calibration/calibration_problem.h"

#include <ceres/ceres.h>
#include <ceres/version.h>

#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"
#include "live_stiffness/estimation/registration_fit.h"

namespace live_stiffness {
namespace {

Eigen::VectorXd valuesAt(const std::vector<SceneParameter>& parameters, const double* x) {
  Eigen::VectorXd values(static_cast<long>(parameters.size()));
  for (size_t k = 0; k < parameters.size(); ++k)
    values[static_cast<long>(k)] =  // rounding must not carry a mass of zero below zero
        std::clamp(parameters[k].start + parameters[k].prior_sigma * x[k], parameters[k].low, parameters[k].high);
  return values;
}

// One sample: position and, with a rotation sigma, orientation of the sensor in the tracker's frame.
class SampleCost : public ceres::CostFunction {
 public:
  SampleCost(RecordingEvaluator& evaluator, size_t sample, const std::vector<SceneParameter>& parameters,
             CalibrationProblem::Sigmas sigmas)
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
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, kRegistrationSize, Eigen::RowMajor>> J(jacobians[own], rows,
                                                                                             kRegistrationSize);
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
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
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
  CalibrationProblem::Sigmas sigmas_;
};

// One row of a compliance table: its nine entries, and its norm, which is what (42) compares. Derivatives by central
// differences of solves to 1e-12: a table has a handful of rows, so all of it costs less than one recording's
// millisecond.
class RowCost : public ceres::CostFunction {
 public:
  RowCost(const CalibrationProblem& problem, size_t row, const Matrix3& measured, double sigma, int parameters)
      : problem_(problem), row_(row), measured_(measured), scale_(1.0 / (sigma * measured.norm())) {
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
    if (!problem_.rowCompliance(row_, x, C)) return false;
    Eigen::Map<Matrix3> entries(residuals);
    entries = scale_ * (C - measured_);
    residuals[9] = scale_ * (C.norm() - measured_.norm());
    return true;
  }

  const CalibrationProblem& problem_;
  size_t row_;
  Matrix3 measured_;
  double scale_;
};

// (x - mean) / sigma of some entries of a block, linear.
class PriorCost : public ceres::CostFunction {
 public:
  PriorCost(int size, std::vector<int> entries, std::vector<double> means, std::vector<double> sigmas)
      : entries_(std::move(entries)), means_(std::move(means)), sigmas_(std::move(sigmas)) {
    set_num_residuals(static_cast<int>(entries_.size()));
    mutable_parameter_block_sizes()->push_back(size);
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const int size = parameter_block_sizes()[0];
    for (size_t k = 0; k < entries_.size(); ++k) residuals[k] = (blocks[0][entries_[k]] - means_[k]) / sigmas_[k];
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    std::fill(jacobians[0], jacobians[0] + entries_.size() * size, 0.0);
    for (size_t k = 0; k < entries_.size(); ++k) jacobians[0][k * size + entries_[k]] = 1.0 / sigmas_[k];
    return true;
  }

 private:
  std::vector<int> entries_;
  std::vector<double> means_, sigmas_;
};

// Holds these entries of the parameters' block where they are, and frees the others.
void hold(ceres::Problem& problem, double* x, int count, const std::vector<int>& entries) {
  if (static_cast<int>(entries.size()) == count) {
    problem.SetParameterBlockConstant(x);
    return;
  }
  problem.SetParameterBlockVariable(x);
#if CERES_VERSION_MAJOR > 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR >= 1)
  problem.SetManifold(x, entries.empty() ? nullptr : new ceres::SubsetManifold(count, entries));
#else
  problem.SetParameterization(x, new ceres::SubsetParameterization(count, entries));
#endif
}

// Entries at a bound of theirs, beyond which the cost would fall.
std::vector<int> pressedAgainstBounds(ceres::Problem& problem, const Eigen::VectorXd& x,
                                      const std::vector<SceneParameter>& parameters) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {const_cast<double*>(x.data())};
  options.num_threads = 1;
  const int count = static_cast<int>(x.size());
  hold(problem, const_cast<double*>(x.data()), count, {});
  double cost = 0.0;
  std::vector<double> gradient;
  std::vector<int> pressed;
  if (!problem.Evaluate(options, &cost, nullptr, &gradient, nullptr)) return pressed;
  for (int k = 0; k < count; ++k) {
    const SceneParameter& p = parameters[static_cast<size_t>(k)];
    const double value = p.start + p.prior_sigma * x[k], near = 1e-9 * (p.high - p.low);
    if ((value < p.low + near && gradient[static_cast<size_t>(k)] > 0.0) ||
        (value > p.high - near && gradient[static_cast<size_t>(k)] < 0.0))
      pressed.push_back(k);
  }
  return pressed;
}

double sampleTime(const Recording& recording) {
  const size_t count = recording.samples.size();
  if (count < 2) return 1.0;
  return (recording.samples.back().time - recording.samples.front().time) / static_cast<double>(count - 1);
}

}  // namespace

RecordingEvaluator::RecordingEvaluator(const Scene& scene, const ChannelMap& channels,
                                       const std::vector<SceneParameter>& parameters, const CalibrationRecording& data,
                                       const CalibrationOptions& options)
    : predictor_(scene, options.model, channels, parameters), data_(data), mount_(options.force_sensor) {
  if (data.recording.channelCount() != channels.channelCount())
    throw ConfigurationError(data.recording.name,
                             {std::to_string(data.recording.channelCount()) + " pressure channels: must be " +
                              std::to_string(channels.channelCount()) + ", as the channel map has"});
  for (size_t i = 0; i < data.channels.size(); ++i)
    samples_.push_back({data.recording.samples[i].time, data.channels[i], Wrench::Zero(), data.used[i]});
  correlation_ = std::max(1.0, options.correlation_time / sampleTime(data.recording));
}

const std::vector<TipPrediction>* RecordingEvaluator::at(const double* x, bool derivatives) {
  const Eigen::VectorXd values =
      x == nullptr ? Eigen::VectorXd() : Eigen::VectorXd(valuesAt(predictor_.parameters(), x));
  const bool same = has_cache_ && cached_.size() == values.size() && cached_ == values;
  if (!same || (derivatives && !cache_has_derivatives_)) {
    cache_ok_ = predictor_.predict(values, samples_, derivatives, predictions_);
    cached_ = values;
    has_cache_ = true;
    cache_has_derivatives_ = derivatives;
  }
  return cache_ok_ ? &predictions_ : nullptr;
}

bool RecordingEvaluator::predictAll(const double* x, std::vector<TipPrediction>& predictions) {
  std::vector<ActuationSample> samples = samples_;
  for (ActuationSample& sample : samples) sample.wanted = true;
  return predictor_.predict(valuesAt(predictor_.parameters(), x), samples, false, predictions);
}

void RecordingEvaluator::updateWrenches(const Registration& registration) {
  for (size_t i = 0; i < samples_.size(); ++i) {
    const RecordedSample& sample = data_.recording.samples[i];
    if (!data_.loaded[i] || !sample.tip_wrench) continue;
    samples_[i].tip_wrench = mount_.atTip(*sample.tip_wrench, registration.tipPose(sample.tipPose()).R);
  }
  has_cache_ = false;
}

Registration RecordingEvaluator::registration(const RegistrationVector& r) const {
  Registration result;
  result.X_AB = {expSo3(r.head<3>()) * start_.X_AB.R, r.segment<3>(3)};
  result.X_TS = {expSo3(r.tail<3>()) * start_.X_TS.R, r.segment<3>(6)};
  return result;
}

void RecordingEvaluator::restart(const double* x) {
  const std::vector<TipPrediction>* predictions = at(x, false);
  if (predictions == nullptr)
    throw ConfigurationError("calibration of " + data_.recording.name,
                             {"the model has no solution at the start: " + failure()});
  std::vector<Pose> X_BT, X_AS;
  for (size_t i = 0; i < samples_.size(); ++i) {
    if (!data_.used[i] || data_.loaded[i]) continue;
    X_BT.push_back((*predictions)[i].X_BT);
    X_AS.push_back(data_.recording.samples[i].tipPose());
  }
  start_ = fitRegistration(X_BT, X_AS).registration;
}

CalibrationProblem::CalibrationProblem(const Scene& scene, const ChannelMap& channels,
                                       const std::vector<SceneParameter>& parameters,
                                       const std::vector<CalibrationRecording>& recordings,
                                       const std::vector<ComplianceRow>& rows, const CalibrationOptions& options)
    : scene_(scene), parameters_(parameters), rows_(rows), options_(options) {
  for (const CalibrationRecording& data : recordings) {
    evaluators_.push_back(std::make_unique<RecordingEvaluator>(scene, channels, parameters, data, options));
    const long used = std::count(data.used.begin(), data.used.end(), true);
    std::vector<int>& blocks = blocks_.emplace_back(data.used.size(), -1);
    long seen = 0;
    for (size_t i = 0; i < blocks.size(); ++i)
      if (data.used[i] && options.blocks > 0) blocks[i] = static_cast<int>(seen++ * options.blocks / used);
  }
  for (const ComplianceRow& row : rows)
    if (row.pressures.size() != scene.chamberCount())
      throw ConfigurationError(row.name, {std::to_string(row.pressures.size()) + " pressures: must be " +
                                          std::to_string(scene.chamberCount())});
}

Eigen::VectorXd CalibrationProblem::values(const Eigen::VectorXd& x) const { return valuesAt(parameters_, x.data()); }

bool CalibrationProblem::rowCompliance(size_t row, const double* x, Matrix3& compliance) const {
  ModelOptions options = options_.model;
  options.accuracy = 1e-12;
  const StiffnessModel model(withParameters(scene_, parameters_, valuesAt(parameters_, x)), options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  const StiffnessSolution solution = model.solve(rows_[row].pressures, Wrench::Zero(), workspace);
  if (!solution.status.ok()) return false;
  compliance = solution.compliance.topLeftCorner<3, 3>();
  return true;
}

CalibrationUnknowns CalibrationProblem::start() {
  CalibrationUnknowns unknowns;
  unknowns.x = Eigen::VectorXd::Zero(static_cast<long>(parameters_.size()));
  for (size_t k = 0; k < parameters_.size(); ++k) {
    // Off the bounds, where a derivative may vanish (no creep has no time constant).
    const SceneParameter& p = parameters_[k];
    const double inset = std::min(0.2 * p.prior_sigma, 0.25 * (p.high - p.low));
    unknowns.x[static_cast<long>(k)] = (std::clamp(p.start, p.low + inset, p.high - inset) - p.start) / p.prior_sigma;
  }
  for (auto& evaluator : evaluators_) {
    evaluator->restart(unknowns.x.data());
    RegistrationVector& r = unknowns.registrations.emplace_back(RegistrationVector::Zero());
    r.segment<3>(3) = evaluator->startRegistration().X_AB.p;
    r.segment<3>(6) = evaluator->startRegistration().X_TS.p;
    evaluator->updateWrenches(evaluator->startRegistration());
  }
  return unknowns;
}

CalibrationProblem::Solution CalibrationProblem::solve(const CalibrationUnknowns& start, const Sigmas& sigmas,
                                                       const LeftOut& left_out, double tolerance,
                                                       bool want_jacobian) {
  Solution solution;
  CalibrationUnknowns& unknowns = solution.unknowns;
  unknowns = start;
  const int count = static_cast<int>(parameters_.size());
  ceres::Problem problem;
  if (count > 0) {
    problem.AddParameterBlock(unknowns.x.data(), count);
    for (int k = 0; k < count; ++k) {
      const SceneParameter& p = parameters_[static_cast<size_t>(k)];
      problem.SetParameterLowerBound(unknowns.x.data(), k, (p.low - p.start) / p.prior_sigma);
      problem.SetParameterUpperBound(unknowns.x.data(), k, (p.high - p.start) / p.prior_sigma);
    }
  }
  std::vector<ceres::ResidualBlockId> data_blocks;
  for (size_t n = 0; n < evaluators_.size(); ++n) {
    const CalibrationRecording& data = evaluators_[n]->data();
    double* registration = unknowns.registrations[n].data();
    for (size_t i = 0; i < data.used.size(); ++i) {
      if (!data.used[i]) continue;
      if (left_out.recording == static_cast<int>(n) && blocks_[n][i] == left_out.block) continue;
      auto* cost = new SampleCost(*evaluators_[n], i, parameters_, sigmas);
      auto* loss = new ceres::ScaledLoss(new ceres::HuberLoss(options_.huber * std::sqrt(cost->num_residuals() / 3.0)),
                                         1.0 / evaluators_[n]->correlation(), ceres::TAKE_OWNERSHIP);
      data_blocks.push_back(count > 0 ? problem.AddResidualBlock(cost, loss, unknowns.x.data(), registration)
                                      : problem.AddResidualBlock(cost, loss, registration));
    }
    const std::vector<double> zeros(3, 0.0), offsets(3, kOffsetSigma);
    problem.AddResidualBlock(new PriorCost(kRegistrationSize, {6, 7, 8}, zeros, offsets), nullptr, registration);
    if (sigmas.rotation <= 0.0)  // nothing else holds the sensor's rotation: it stays where it is
      problem.AddResidualBlock(new PriorCost(kRegistrationSize, {9, 10, 11}, zeros, {1, 1, 1}), nullptr,
                               registration);
  }
  for (size_t row = 0; row < rows_.size() && count > 0; ++row)
    if (static_cast<int>(row) != left_out.row)
      data_blocks.push_back(problem.AddResidualBlock(
          new RowCost(*this, row, rows_[row].compliance, options_.compliance_sigma, count), nullptr,
          unknowns.x.data()));
  if (options_.use_priors && count > 0) {
    std::vector<int> entries;
    std::vector<double> means, ones;
    for (int k = 0; k < count; ++k) {
      const SceneParameter& p = parameters_[static_cast<size_t>(k)];
      entries.push_back(k);
      means.push_back((p.prior_mean - p.start) / p.prior_sigma);
      ones.push_back(1.0);
    }
    problem.AddResidualBlock(new PriorCost(count, entries, means, ones), nullptr, unknowns.x.data());
  }

  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.function_tolerance = tolerance;
  solver.parameter_tolerance = 1e-8;
  solver.max_num_line_search_step_size_iterations = 4;
  solver.logging_type = ceres::SILENT;
  solver.num_threads = 1;  // predictions are shared by all samples of a recording
  // Ceres creeps along a bound; so what has run into one, with the cost falling beyond, is held there and the search
  // goes on.
  const int most = tolerance > 1e-6 ? 12 : 40;
  std::vector<int> held = count > 0 ? pressedAgainstBounds(problem, unknowns.x, parameters_) : std::vector<int>();
  for (int attempt = 0; attempt < 4 && problem.NumParameterBlocks() > 0; ++attempt) {
    if (count > 0) hold(problem, unknowns.x.data(), count, held);
    solver.max_num_iterations = attempt == 0 && held.empty() ? 8 : most;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    solution.converged = summary.termination_type == ceres::CONVERGENCE;
    solution.message = summary.message;
    solution.iterations += static_cast<int>(summary.iterations.size());
    if (summary.termination_type == ceres::FAILURE) break;
    const std::vector<int> pressed =
        count > 0 ? pressedAgainstBounds(problem, unknowns.x, parameters_) : std::vector<int>();
    if (solution.converged && pressed == held) break;
    held = pressed;
  }
  if (count > 0) hold(problem, unknowns.x.data(), count, {});
  if (!want_jacobian) return solution;

  ceres::Problem::EvaluateOptions evaluate;
  evaluate.residual_blocks = data_blocks;
  if (count > 0) evaluate.parameter_blocks.push_back(unknowns.x.data());
  for (RegistrationVector& r : unknowns.registrations) evaluate.parameter_blocks.push_back(r.data());
  evaluate.num_threads = 1;
  std::vector<double> residuals;
  ceres::CRSMatrix sparse;
  double cost = 0.0;
  if (!problem.Evaluate(evaluate, &cost, &residuals, nullptr, &sparse)) return solution;
  solution.residuals = Eigen::Map<Eigen::VectorXd>(residuals.data(), static_cast<long>(residuals.size()));
  solution.jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row)
    for (int k = sparse.rows[row]; k < sparse.rows[row + 1]; ++k)
      solution.jacobian(row, sparse.cols[k]) = sparse.values[k];
  return solution;
}

}  // namespace live_stiffness
