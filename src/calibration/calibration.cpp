#include "calibration/calibration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/base_sensor.h"
#include "calibration/calibration_problem.h"
#include "calibration/carrying_moduli.h"
#include "calibration/parameter_uncertainty.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

constexpr double kCoarse = 1e-4, kFine = 1e-7;  // relative change of the cost at which a search ends

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Of the sensor, A axes: predicted minus measured, m and rad; no rotation where the tracker measures none.
Twist errorOf(const Registration& registration, const Pose& X_BT, const RecordedSample& sample, TrackerMeasures measures) {
  const Pose X_AS = registration.sensorPose(X_BT);
  return residualTwist(X_AS, completedPose(sample.tipPose(), X_AS, measures));
}

// Standard deviations for each axis, from the residuals of the fitted samples. 1.538 is the median length of a 3-vector whose
// components have unit variance, 1.177 of a 2-vector (the tilt of an axis). At least a tenth of the tracker's noise, so that a
// simulation without noise is well conditioned.
ResidualSigmas residualSigmas(CalibrationProblem& problem, size_t recordings,
                                          const CalibrationProblem::Solution& solution,
                                          const CalibrationOptions& options) {
  constexpr double kMedianLength = 1.538, kMedianTilt = 1.177, kLeastPosition = 3e-5, kLeastRotation = 3e-4;
  std::vector<double> positions, rotations;
  for (size_t n = 0; n < recordings; ++n) {
    RecordingEvaluator& evaluator = problem.evaluator(n);
    const TrackerMeasures measures = evaluator.measures();
    const Registration registration = problem.registration(solution.unknowns, n);
    const TipPredictions* predictions = evaluator.at(solution.unknowns.x.data(), false);
    if (predictions == nullptr) continue;
    for (size_t i = 0; i < predictions->X_BT.size(); ++i) {
      if (!evaluator.fits(i)) continue;
      const Twist error = errorOf(registration, predictions->X_BT[i], evaluator.data().recording.samples[i], measures);
      positions.push_back(linear(error).norm() / kMedianLength);
      if (measures == TrackerMeasures::kPosition) continue;
      rotations.push_back(angular(error).norm() / (measures == TrackerMeasures::kPose ? kMedianLength : kMedianTilt));
    }
  }
  if (positions.empty()) return {options.position_sigma, options.rotation_sigma};
  return {std::max(quantile(positions, 0.5), kLeastPosition),
          options.rotation_sigma > 0.0 && !rotations.empty() ? std::max(quantile(rotations, 0.5), kLeastRotation) : 0.0};
}

void describeRecording(CalibrationProblem& problem, const CalibrationProblem::Solution& solution, size_t n,
                       RecordingFit& fit) {
  RecordingEvaluator& evaluator = problem.evaluator(n);
  const CalibrationRecording& data = evaluator.data();
  fit.name = data.recording.name;
  fit.relative_to_base = data.relative_to_base;
  fit.registration = problem.registration(solution.unknowns, n);
  std::vector<Pose> predictions;
  const std::vector<bool> solved = evaluator.predictAll(solution.unknowns.x.data(), predictions);
  std::vector<double> used, quiet;
  for (size_t i = 0; i < predictions.size(); ++i) {
    Twist error = errorOf(fit.registration, predictions[i], data.recording.samples[i], evaluator.measures());
    if (!solved[i]) error.setConstant(kNaN);
    fit.without_equilibrium += !solved[i];
    fit.repeated += data.recording.samples[i].unchanged_for > 0.0;
    fit.position_error.push_back(linear(error).norm());
    fit.rotation_error.push_back(evaluator.measures() == TrackerMeasures::kPosition ? kNaN : angular(error).norm());
    fit.position_residual.push_back(fit.registration.X_AB.R.transpose() * linear(error));
    if (data.used[i] && solved[i]) used.push_back(fit.position_error[i]);
  }
  for (int i : quasiStaticSamples(data.recording))
    if (isUnloaded(data.recording.samples[i]) && solved[i]) quiet.push_back(fit.position_error[i]);
  fit.used = summarizeErrors(std::move(used));
  fit.quasi_static_unloaded = summarizeErrors(std::move(quiet));
  fit.left_out_error.assign(predictions.size(), kNaN);
}

void checkSizes(const Scene& scene, const ChannelMap& channels, const std::vector<CalibrationRecording>& recordings,
                const std::vector<ComplianceRow>& rows) {
  if (channels.chamberCount() != scene.chamberCount())
    throw ConfigurationError("channel map", {"feeds " + std::to_string(channels.chamberCount()) + " chambers: must be the "
                                             "scene's " + std::to_string(scene.chamberCount())});
  for (const CalibrationRecording& data : recordings)
    if (data.recording.channelCount() < channels.channelCount())
      throw ConfigurationError(data.recording.name,
                               {std::to_string(data.recording.channelCount()) + " pressure channels: must be at least " +
                                std::to_string(channels.channelCount()) + ", as the channel map has"});
  for (const ComplianceRow& row : rows)
    if (row.pressures.size() != scene.chamberCount())
      throw ConfigurationError(row.name, {std::to_string(row.pressures.size()) + " pressures: must be " +
                                          std::to_string(scene.chamberCount())});
}

bool isModulus(const SceneParameter& parameter) {
  return parameter.name == "youngs_modulus_pa" || parameter.name == "shear_modulus_pa";
}

bool fitsModuli(const std::vector<SceneParameter>& parameters) {
  return std::any_of(parameters.begin(), parameters.end(), [](const SceneParameter& p) { return p.name == "youngs_modulus_pa"; });
}

// Moduli with their start, and unless the user has given another one their prior, times a factor.
std::vector<SceneParameter> withModuliTimes(std::vector<SceneParameter> parameters, double factor) {
  for (SceneParameter& p : parameters) {
    if (!isModulus(p)) continue;
    if (p.prior_mean == p.start) {
      p.prior_mean *= factor;
      p.prior_sigma *= factor;
    }
    p.start *= factor;
    p.step *= factor;
  }
  return parameters;
}

// Used samples at even ranks of their summed pressure, the highest first: these fail first.
SamplesToCarry someSamples(const CalibrationRecording& data, const ChannelMap& channels) {
  constexpr size_t kEnough = 24;
  std::vector<size_t> order;
  for (size_t i = 0; i < data.used.size(); ++i)
    if (data.used[i]) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t i, size_t j) { return data.channels[i].sum() > data.channels[j].sum(); });
  SamplesToCarry some;
  const size_t count = std::min(kEnough, order.size());
  for (size_t k = 0; k < count; ++k) {
    const size_t i = order[(2 * k + 1) * order.size() / (2 * count)];
    some.pressures.push_back(channels.expand(data.channels[i]));
    some.X_AS.push_back(data.recording.samples[i].tipPose());
  }
  return some;
}

// The factor on the moduli to start with, and what there is to say about it: 1 and nothing if those of the scene carry nearly
// all samples and rows. Throws ConfigurationError where they do not, nor can be changed, and too much would be left out.
std::pair<double, std::string> carryingModuli(const Scene& scene, const ChannelMap& channels,
                                              const std::vector<CalibrationRecording>& recordings,
                                              const std::vector<ComplianceRow>& rows, const ModelOptions& model,
                                              bool fits_moduli) {
  std::vector<SamplesToCarry> samples;
  for (const CalibrationRecording& data : recordings) samples.push_back(someSamples(data, channels));
  samples.emplace_back();
  for (const ComplianceRow& row : rows) samples.back().pressures.push_back(row.pressures);
  double count = 0.0;
  for (const SamplesToCarry& some : samples) count += static_cast<double>(some.pressures.size());
  const long most = static_cast<long>(kMostShare * count), without = withoutEquilibrium(scene, model, samples, most);
  if (static_cast<double>(without) <= std::max(1.0, kFewShare * count)) return {1.0, ""};
  const std::optional<double> factor = carryingFactor(scene, model, samples);
  std::string text = "with the moduli of the scene " + std::string(without > most ? "more than " : "") +
                     std::to_string(std::min(without, most)) + " of " + numberText(count) + " samples tried have no equilibrium";
  if (!factor) {
    text += ", and no other moduli carry the robot: check pressures, sizes and masses";
  } else {
    double youngs_modulus = 0.0;
    walk(scene, [&](int index, const Segment& s) { if (index == 0) youngs_modulus = s.section.youngs_modulus; },
         [](const Link&) {});
    text += "; " + numberText(*factor) + " times as large ones carry the robot (youngs_modulus_pa: " +
            numberText(*factor * youngs_modulus) + ")";
    if (fits_moduli) return {*factor, text + ", so the fit starts there"};
    text += ": set them in the scene, or fit them by calibrate --parameters youngs_modulus_pa";
  }
  if (without > most) throw ConfigurationError("calibration", {text});
  return {1.0, text};
}

}  // namespace

CalibrationRecording::CalibrationRecording(Recording given, SampleChoice choice, LoadedSamples loads)
    : recording(relativeToBase(given)), channels(gaugePressures(recording)), relative_to_base(hasBasePoses(given)) {
  used.assign(recording.samples.size(), choice == SampleChoice::kAll);
  loaded.assign(recording.samples.size(), false);
  if (choice == SampleChoice::kQuasiStatic)
    for (int i : quasiStaticSamples(recording)) used[static_cast<size_t>(i)] = true;
  for (size_t i = 0; i < used.size(); ++i) {
    if (isUnloaded(recording.samples[i])) continue;
    loaded[i] = loads != LoadedSamples::kIgnore;
    used[i] = used[i] && loads == LoadedSamples::kFit;
  }
  long unloaded = 0, repeated = 0;
  for (size_t i = 0; i < used.size(); ++i) {
    repeated += recording.samples[i].unchanged_for > 0.0;
    used[i] = used[i] && !(recording.samples[i].unchanged_for > 0.0);
    unloaded += used[i] && !loaded[i];
  }
  if (unloaded < 3)
    throw ConfigurationError("recording " + recording.name,
                             {std::to_string(unloaded) +
                              " unloaded samples of the kind asked for: must be at least 3" +
                              (repeated > 0 ? ", and " + std::to_string(repeated) + " only repeat the pose before" : "")});
}

CalibrationResult calibrate(const Scene& given_scene, const ChannelMap& channels,
                            const std::vector<SceneParameter>& given_parameters,
                            const std::vector<CalibrationRecording>& recordings, const std::vector<ComplianceRow>& rows,
                            const CalibrationOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto progress = [&](const std::string& stage, int done, int total) {
    if (options.progress) options.progress(stage, done, total);
  };
  checkSizes(given_scene, channels, recordings, rows);
  const bool fits_moduli = fitsModuli(given_parameters);
  const auto [factor, moduli] = carryingModuli(given_scene, channels, recordings, rows, options.model, fits_moduli);
  const Scene scene = withModuliTimes(given_scene, factor);
  const std::vector<SceneParameter> parameters = withModuliTimes(given_parameters, factor);
  CalibrationProblem problem(scene, channels, parameters, recordings, rows, options);
  ResidualSigmas sigmas{options.position_sigma, options.rotation_sigma};
  progress("fitting", 0, 3);
  CalibrationProblem::Solution solution = problem.solve(problem.start(moduli), sigmas, {}, kCoarse);
  for (int round = 1; round <= 2; ++round) {  // second round: with the sigmas and the tip orientations of the first
    progress("fitting", round, 3);
    sigmas = residualSigmas(problem, recordings.size(), solution, options);
    for (size_t n = 0; n < recordings.size(); ++n) {
      const double* x = solution.unknowns.x.data();
      problem.evaluator(n).orientTips(x, problem.registration(solution.unknowns, n));
      problem.evaluator(n).chooseFitted(x);
    }
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
  result.moduli = moduli;
  for (RecordingFit& fit : result.recordings) {
    if (moduli.empty() || fits_moduli) continue;
    fit.determined = false;
    fit.verdict = "NOT determined: " + moduli;
  }

  const int blocks = std::max(options.blocks, 0);
  const int total = blocks * static_cast<int>(recordings.size()) + (blocks > 0 ? static_cast<int>(rows.size()) : 0);
  int done = 0;
  for (size_t n = 0; n < recordings.size(); ++n) {
    RecordingFit& fit = result.recordings[n];
    for (int block = 0; block < blocks; ++block) {
      progress("leaving blocks out", done++, total);
      const auto without = problem.solve(solution.unknowns, sigmas, {static_cast<int>(n), block, -1}, kCoarse);
      RecordingEvaluator& evaluator = problem.evaluator(n);
      const Registration registration = problem.registration(without.unknowns, n);
      const TipPredictions* predictions = evaluator.at(without.unknowns.x.data(), false);
      if (predictions == nullptr) continue;
      for (size_t i = 0; i < predictions->X_BT.size(); ++i)
        if (problem.blockOf(n, i) == block && evaluator.fits(i))
          fit.left_out_error[i] =
              (registration.sensorPose(predictions->X_BT[i]).p - recordings[n].recording.samples[i].tip_position).norm();
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
      fit.predicted.setConstant(kNaN);
    fit.norm_error = std::abs(norm - fit.predicted.norm()) / norm;
    fit.matrix_error = (fit.measured - fit.predicted).norm() / norm;
    fit.left_out = fit.predicted;
    if (blocks > 0) {
      progress("leaving blocks out", done++, total);
      const auto without = problem.solve(solution.unknowns, sigmas, {-1, -1, static_cast<int>(row)}, kFine);
      if (!problem.rowCompliance(row, problem.values(without.unknowns.x), fit.left_out)) fit.left_out.setConstant(kNaN);
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
