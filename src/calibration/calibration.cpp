#include "calibration/calibration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "calibration/calibration_problem.h"
#include "calibration/parameter_uncertainty.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

constexpr double kCoarse = 1e-4, kFine = 1e-7;  // relative change of the cost at which a search ends

// Of the sensor, A axes: predicted minus measured, m and rad.
Twist errorOf(const Registration& registration, const Pose& X_BT, const RecordedSample& sample) {
  return residualTwist(registration.sensorPose(X_BT), sample.tipPose());
}

// Standard deviations for each axis, from the residuals of the used samples. 1.538 is the median length of a 3-vector whose
// components have unit variance. At least a tenth of the tracker's noise, so that a simulation without noise is well
// conditioned.
ResidualSigmas residualSigmas(CalibrationProblem& problem, size_t recordings,
                                          const CalibrationProblem::Solution& solution,
                                          const CalibrationOptions& options) {
  std::vector<double> positions, rotations;
  for (size_t n = 0; n < recordings; ++n) {
    RecordingEvaluator& evaluator = problem.evaluator(n);
    const Registration registration = evaluator.registration(solution.unknowns.registrations[n]);
    const TipPredictions* predictions = evaluator.at(solution.unknowns.x.data(), false);
    if (predictions == nullptr) continue;
    for (size_t i = 0; i < predictions->X_BT.size(); ++i) {
      if (!evaluator.data().used[i]) continue;
      const Twist error = errorOf(registration, predictions->X_BT[i], evaluator.data().recording.samples[i]);
      positions.push_back(linear(error).norm());
      rotations.push_back(angular(error).norm());
    }
  }
  if (positions.empty()) return {options.position_sigma, options.rotation_sigma};
  constexpr double kMedianLength = 1.538, kLeastPosition = 3e-5, kLeastRotation = 3e-4;
  return {std::max(quantile(positions, 0.5) / kMedianLength, kLeastPosition),
          options.rotation_sigma > 0.0 ? std::max(quantile(rotations, 0.5) / kMedianLength, kLeastRotation) : 0.0};
}

void describeRecording(CalibrationProblem& problem, const CalibrationProblem::Solution& solution, size_t n,
                       RecordingFit& fit) {
  RecordingEvaluator& evaluator = problem.evaluator(n);
  const CalibrationRecording& data = evaluator.data();
  fit.name = data.recording.name;
  fit.registration = evaluator.registration(solution.unknowns.registrations[n]);
  std::vector<Pose> predictions;
  if (!evaluator.predictAll(solution.unknowns.x.data(), predictions))
    throw ConfigurationError("calibration of " + fit.name, {"a sample has no solution: " + evaluator.failure()});
  std::vector<double> used, quiet;
  for (size_t i = 0; i < predictions.size(); ++i) {
    const Twist error = errorOf(fit.registration, predictions[i], data.recording.samples[i]);
    fit.position_error.push_back(linear(error).norm());
    fit.rotation_error.push_back(angular(error).norm());
    fit.position_residual.push_back(fit.registration.X_AB.R.transpose() * linear(error));
    if (data.used[i]) used.push_back(fit.position_error[i]);
  }
  for (int i : quasiStaticSamples(data.recording))
    if (isUnloaded(data.recording.samples[i])) quiet.push_back(fit.position_error[i]);
  fit.used = summarizeErrors(std::move(used));
  fit.quasi_static_unloaded = summarizeErrors(std::move(quiet));
  fit.left_out_error.assign(predictions.size(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

CalibrationRecording::CalibrationRecording(Recording given, SampleChoice choice, LoadedSamples loads)
    : recording(std::move(given)), channels(gaugePressures(recording)) {
  used.assign(recording.samples.size(), choice == SampleChoice::kAll);
  loaded.assign(recording.samples.size(), false);
  if (choice == SampleChoice::kQuasiStatic)
    for (int i : quasiStaticSamples(recording)) used[static_cast<size_t>(i)] = true;
  for (size_t i = 0; i < used.size(); ++i) {
    if (isUnloaded(recording.samples[i])) continue;
    loaded[i] = loads != LoadedSamples::kIgnore;
    used[i] = used[i] && loads == LoadedSamples::kFit;
  }
  long unloaded = 0;
  for (size_t i = 0; i < used.size(); ++i) unloaded += used[i] && !loaded[i];
  if (unloaded < 3)
    throw ConfigurationError("recording " + recording.name,
                             {std::to_string(unloaded) +
                              " unloaded samples of the kind asked for: must be at least 3"});
}

CalibrationResult calibrate(const Scene& scene, const ChannelMap& channels,
                            const std::vector<SceneParameter>& parameters,
                            const std::vector<CalibrationRecording>& recordings, const std::vector<ComplianceRow>& rows,
                            const CalibrationOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto progress = [&](const std::string& stage, int done, int total) {
    if (options.progress) options.progress(stage, done, total);
  };
  CalibrationProblem problem(scene, channels, parameters, recordings, rows, options);
  ResidualSigmas sigmas{options.position_sigma, options.rotation_sigma};
  progress("fitting", 0, 3);
  CalibrationProblem::Solution solution = problem.solve(problem.start(), sigmas, {}, kCoarse);
  for (int round = 1; round <= 2; ++round) {  // second round: with the sigmas and the tip orientations of the first
    progress("fitting", round, 3);
    sigmas = residualSigmas(problem, recordings.size(), solution, options);
    for (size_t n = 0; n < recordings.size(); ++n)
      problem.evaluator(n).orientTips(problem.evaluator(n).registration(solution.unknowns.registrations[n]));
    solution = problem.solve(solution.unknowns, sigmas, {}, round == 2 ? kFine : kCoarse, round == 2);
  }
  progress("fitting", 3, 3);

  CalibrationResult result;
  result.converged = solution.converged;
  result.message = solution.message;
  result.iterations = solution.iterations;
  result.position_sigma = sigmas.position;
  result.rotation_sigma = sigmas.rotation;
  result.scene = withParameters(scene, parameters, problem.values(solution.unknowns.x));
  result.force_sensor = withParameters(options.force_sensor, parameters, problem.values(solution.unknowns.x));
  result.recordings.resize(recordings.size());
  for (size_t n = 0; n < recordings.size(); ++n) describeRecording(problem, solution, n, result.recordings[n]);
  describeParameters(problem, parameters, solution, recordings.size(), options.use_priors, result);

  const int blocks = std::max(options.blocks, 0);
  const int total = blocks * static_cast<int>(recordings.size()) + (blocks > 0 ? static_cast<int>(rows.size()) : 0);
  int done = 0;
  for (size_t n = 0; n < recordings.size(); ++n) {
    RecordingFit& fit = result.recordings[n];
    for (int block = 0; block < blocks; ++block) {
      progress("leaving blocks out", done++, total);
      const auto without = problem.solve(solution.unknowns, sigmas, {static_cast<int>(n), block, -1}, kCoarse);
      RecordingEvaluator& evaluator = problem.evaluator(n);
      const Registration registration = evaluator.registration(without.unknowns.registrations[n]);
      const TipPredictions* predictions = evaluator.at(without.unknowns.x.data(), false);
      if (predictions == nullptr) continue;
      for (size_t i = 0; i < predictions->X_BT.size(); ++i)
        if (problem.blockOf(n, i) == block)
          fit.left_out_error[i] =
              linear(errorOf(registration, predictions->X_BT[i], recordings[n].recording.samples[i])).norm();
    }
    std::vector<double> left_out;
    for (double error : fit.left_out_error)
      if (std::isfinite(error)) left_out.push_back(error);
    if (!left_out.empty()) fit.left_out = summarizeErrors(std::move(left_out));
  }
  for (size_t row = 0; row < rows.size(); ++row) {
    ComplianceFit fit;
    fit.name = rows[row].name;
    fit.measured = rows[row].compliance;
    const double norm = fit.measured.norm();
    if (!problem.rowCompliance(row, problem.values(solution.unknowns.x), fit.predicted))
      throw ConfigurationError(fit.name, {"the fitted model has no solution there"});
    fit.norm_error = std::abs(norm - fit.predicted.norm()) / norm;
    fit.matrix_error = (fit.measured - fit.predicted).norm() / norm;
    fit.left_out = fit.predicted;
    if (blocks > 0) {
      progress("leaving blocks out", done++, total);
      const auto without = problem.solve(solution.unknowns, sigmas, {-1, -1, static_cast<int>(row)}, kFine);
      if (!problem.rowCompliance(row, problem.values(without.unknowns.x), fit.left_out)) fit.left_out.setConstant(NAN);
    }
    fit.left_out_norm_error = std::abs(norm - fit.left_out.norm()) / norm;
    fit.left_out_matrix_error = (fit.measured - fit.left_out).norm() / norm;
    result.rows.push_back(fit);
  }
  if (total > 0) progress("leaving blocks out", total, total);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace live_stiffness
