#include "calibration/calibration_problem.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <ceres/version.h>

#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"
#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/estimation/registration_fit.h"

namespace live_stiffness {
namespace {

// Adds x, in units of prior sigmas from the start, as a block of the problem with the parameters' bounds.
void addBoundedBlock(ceres::Problem& problem, Eigen::VectorXd& x, const std::vector<SceneParameter>& parameters) {
  problem.AddParameterBlock(x.data(), static_cast<int>(x.size()));
  for (size_t k = 0; k < parameters.size(); ++k) {
    const SceneParameter& p = parameters[k];
    problem.SetParameterLowerBound(x.data(), static_cast<int>(k), (p.low - p.start) / p.prior_sigma);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(k), (p.high - p.start) / p.prior_sigma);
  }
}

// Holds these entries of x where they are, and frees the others.
void hold(ceres::Problem& problem, Eigen::VectorXd& x, const std::vector<int>& entries) {
  const int count = static_cast<int>(x.size());
  if (static_cast<int>(entries.size()) == count) {
    problem.SetParameterBlockConstant(x.data());
    return;
  }
  problem.SetParameterBlockVariable(x.data());
#if CERES_VERSION_MAJOR > 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR >= 1)
  problem.SetManifold(x.data(), entries.empty() ? nullptr : new ceres::SubsetManifold(count, entries));
#else
  problem.SetParameterization(x.data(), new ceres::SubsetParameterization(count, entries));
#endif
}

// Frees x; returns its entries that are at a bound beyond which the cost would fall.
std::vector<int> pressedAgainstBounds(ceres::Problem& problem, Eigen::VectorXd& x,
                                      const std::vector<SceneParameter>& parameters) {
  hold(problem, x, {});
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {x.data()};
  options.num_threads = 1;
  double cost = 0.0;
  std::vector<double> gradient;
  std::vector<int> pressed;
  if (!problem.Evaluate(options, &cost, nullptr, &gradient, nullptr)) return pressed;
  for (int k = 0; k < static_cast<int>(x.size()); ++k) {
    const SceneParameter& p = parameters[static_cast<size_t>(k)];
    const double value = p.start + p.prior_sigma * x[k], near = 1e-9 * (p.high - p.low);
    if ((value < p.low + near && gradient[k] > 0.0) || (value > p.high - near && gradient[k] < 0.0)) pressed.push_back(k);
  }
  return pressed;
}

}  // namespace

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
}

Eigen::VectorXd CalibrationProblem::values(const Eigen::VectorXd& x) const { return valuesAt(parameters_, x.data()); }

bool CalibrationProblem::rowCompliance(size_t row, const Eigen::VectorXd& values, Matrix3& compliance) const {
  ModelOptions options = options_.model;
  options.accuracy = 1e-12;
  const StiffnessModel model(withParameters(scene_, parameters_, values), options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  const StiffnessSolution solution = model.solve(rows_[row].pressures, Wrench::Zero(), workspace);
  if (!solution.status.ok()) return false;
  compliance = solution.compliance.topLeftCorner<3, 3>();
  return true;
}

CalibrationUnknowns CalibrationProblem::start(const std::string& advice) {
  CalibrationUnknowns unknowns;
  unknowns.x = Eigen::VectorXd::Zero(static_cast<long>(parameters_.size()));
  for (size_t k = 0; k < parameters_.size(); ++k) {
    // Not on the bounds, where a derivative may vanish (without creep the time constant has no effect).
    const SceneParameter& p = parameters_[k];
    const double inset = std::min(0.2 * p.prior_sigma, 0.25 * (p.high - p.low));
    unknowns.x[static_cast<long>(k)] = (std::clamp(p.start, p.low + inset, p.high - inset) - p.start) / p.prior_sigma;
  }
  const double* x = unknowns.x.data();
  std::vector<std::vector<Pose>> X_BT(evaluators_.size()), X_AS(evaluators_.size());
  for (size_t n = 0; n < evaluators_.size(); ++n) {
    RecordingEvaluator& evaluator = *evaluators_[n];
    if (!evaluator.chooseFitted(x))
      throw ConfigurationError("calibration of " + evaluator.data().recording.name,
                               {"more than a fifth of the samples have no equilibrium at the start: " + evaluator.failure() +
                                (advice.empty() ? "" : "; " + advice)});
    evaluator.addPairs(x, X_BT[registrationIndex(n)], X_AS[registrationIndex(n)]);
  }
  for (size_t n = 0; n < evaluators_.size(); ++n) {
    const size_t index = registrationIndex(n);
    if (index == unknowns.registrations.size()) {
      const Registration start =
          options_.given ? *options_.given
                         : fitRegistration(X_BT[index], X_AS[index], evaluators_[n]->measures()).registration;
      for (size_t m = n; m < evaluators_.size(); ++m) evaluators_[m]->startFrom(start);  // later ones may get their own
      unknowns.registrations.emplace_back() << Vector3::Zero(), start.X_AB.p, start.X_TS.p, Vector3::Zero();
    }
    evaluators_[n]->orientTips(x, registration(unknowns, n));
  }
  return unknowns;
}

std::vector<ceres::ResidualBlockId> CalibrationProblem::addData(ceres::Problem& problem, CalibrationUnknowns& unknowns,
                                                                const ResidualSigmas& sigmas, const LeftOut& left_out) {
  const int count = static_cast<int>(parameters_.size());
  std::vector<ceres::ResidualBlockId> added;
  for (size_t n = 0; n < evaluators_.size(); ++n) {
    const CalibrationRecording& data = evaluators_[n]->data();
    double* registration = unknowns.registrations[registrationIndex(n)].data();
    for (size_t i = 0; i < data.used.size(); ++i) {
      if (!evaluators_[n]->fits(i)) continue;
      if (left_out.recording == static_cast<int>(n) && blocks_[n][i] == left_out.block) continue;
      auto* cost = new SampleCost(*evaluators_[n], i, parameters_, sigmas);
      auto* loss = new ceres::ScaledLoss(new ceres::HuberLoss(options_.huber * std::sqrt(cost->num_residuals() / 3.0)),
                                         1.0 / evaluators_[n]->correlation(), ceres::TAKE_OWNERSHIP);
      added.push_back(count > 0 ? problem.AddResidualBlock(cost, loss, unknowns.x.data(), registration)
                                : problem.AddResidualBlock(cost, loss, registration));
    }
    if (options_.given && problem.HasParameterBlock(registration)) problem.SetParameterBlockConstant(registration);
  }
  for (size_t row = 0; row < rows_.size() && count > 0; ++row) {
    if (static_cast<int>(row) == left_out.row) continue;
    const auto compliance = [this, row](const Eigen::VectorXd& values, Matrix3& C) { return rowCompliance(row, values, C); };
    auto* cost = new ComplianceCost(compliance, rows_[row].compliance, options_.compliance_sigma, parameters_);
    added.push_back(problem.AddResidualBlock(cost, nullptr, unknowns.x.data()));
  }
  return added;
}

void CalibrationProblem::addPriors(ceres::Problem& problem, CalibrationUnknowns& unknowns, const ResidualSigmas& sigmas) const {
  // Normal distribution of three entries of a registration about zero.
  const auto add_prior = [&](RegistrationVector& r, int first, double sigma) {
    ceres::Matrix information_root = ceres::Matrix::Zero(3, kRegistrationSize);
    information_root.block<3, 3>(0, first).diagonal().setConstant(1.0 / sigma);
    const ceres::Vector mean = ceres::Vector::Zero(kRegistrationSize);
    problem.AddResidualBlock(new ceres::NormalPrior(information_root, mean), nullptr, r.data());
  };
  for (size_t n = 0; n < unknowns.registrations.size() && !options_.given; ++n) {
    RegistrationVector& r = unknowns.registrations[n];
    add_prior(r, 6, kOffsetSigma);
    // Where nothing else determines the sensor's rotation, it is kept.
    if (sigmas.rotation <= 0.0 || !measuresRotation(n)) add_prior(r, 9, 1.0);
  }
  if (!options_.use_priors || parameters_.empty()) return;
  const long count = static_cast<long>(parameters_.size());
  ceres::Vector mean(count);
  for (long k = 0; k < count; ++k) {
    const SceneParameter& p = parameters_[static_cast<size_t>(k)];
    mean[k] = (p.prior_mean - p.start) / p.prior_sigma;
  }
  problem.AddResidualBlock(new ceres::NormalPrior(ceres::Matrix::Identity(count, count), mean), nullptr,
                           unknowns.x.data());
}

bool CalibrationProblem::measuresRotation(size_t registration) const {
  for (size_t n = 0; n < evaluators_.size(); ++n)
    if (registrationIndex(n) == registration && evaluators_[n]->measures() == TrackerMeasures::kPose) return true;
  return false;
}

void CalibrationProblem::search(ceres::Problem& problem, double tolerance, Solution& solution) const {
  Eigen::VectorXd& x = solution.unknowns.x;
  const bool bounded = !parameters_.empty();
  const auto pressed = [&] {
    return bounded ? pressedAgainstBounds(problem, x, parameters_) : std::vector<int>();
  };
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.function_tolerance = tolerance;
  solver.parameter_tolerance = 1e-8;
  solver.max_num_line_search_step_size_iterations = 4;
  solver.logging_type = ceres::SILENT;
  solver.num_threads = 1;  // predictions are shared by all samples of a recording
  // Ceres makes very small steps along a bound. So parameters that have reached a bound, beyond which the cost would fall,
  // are held constant, and the search continues.
  const int most = tolerance > 1e-6 ? 12 : 40;
  std::vector<int> held = pressed();
  for (int attempt = 0; attempt < 4 && problem.NumParameterBlocks() > 0; ++attempt) {
    if (bounded) hold(problem, x, held);
    solver.max_num_iterations = attempt == 0 && held.empty() ? 8 : most;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    solution.converged = summary.termination_type == ceres::CONVERGENCE;
    solution.message = summary.message;
    solution.iterations += static_cast<int>(summary.iterations.size());
    if (summary.termination_type == ceres::FAILURE) break;
    const std::vector<int> now = pressed();
    if (solution.converged && now == held) break;
    held = now;
  }
  if (bounded) hold(problem, x, {});
}

CalibrationProblem::Solution CalibrationProblem::solve(const CalibrationUnknowns& start, const ResidualSigmas& sigmas,
                                                       const LeftOut& left_out, double tolerance,
                                                       bool want_jacobian) {
  Solution solution;
  CalibrationUnknowns& unknowns = solution.unknowns;
  unknowns = start;
  ceres::Problem problem;
  if (!parameters_.empty()) addBoundedBlock(problem, unknowns.x, parameters_);
  ceres::Problem::EvaluateOptions evaluate;
  evaluate.residual_blocks = addData(problem, unknowns, sigmas, left_out);
  addPriors(problem, unknowns, sigmas);
  search(problem, tolerance, solution);
  if (!want_jacobian) return solution;

  if (!parameters_.empty()) evaluate.parameter_blocks.push_back(unknowns.x.data());
  for (RegistrationVector& r : unknowns.registrations)
    if (!options_.given) evaluate.parameter_blocks.push_back(r.data());
  if (evaluate.parameter_blocks.empty()) return solution;  // Ceres would take all blocks
  evaluate.num_threads = 1;
  std::vector<double> residuals;
  ceres::CRSMatrix sparse;
  double cost = 0.0;
  if (!problem.Evaluate(evaluate, &cost, &residuals, nullptr, &sparse)) {  // then nothing is known of the parameters
    solution.jacobian =
        Eigen::MatrixXd::Zero(1, unknowns.x.size() + (options_.given ? 0 : kRegistrationSize * unknowns.registrations.size()));
    return solution;
  }
  solution.residuals = Eigen::Map<Eigen::VectorXd>(residuals.data(), static_cast<long>(residuals.size()));
  solution.jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row)
    for (int k = sparse.rows[row]; k < sparse.rows[row + 1]; ++k)
      solution.jacobian(row, sparse.cols[k]) = sparse.values[k];
  return solution;
}

}  // namespace live_stiffness
