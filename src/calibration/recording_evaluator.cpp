#include "calibration/recording_evaluator.h"

#include <algorithm>

#include "estimation/creep.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/estimation/registration_fit.h"

namespace live_stiffness {
namespace {

double sampleTime(const Recording& recording) {
  const size_t count = recording.samples.size();
  if (count < 2) return 1.0;
  return (recording.samples.back().time - recording.samples.front().time) / static_cast<double>(count - 1);
}

}  // namespace

RecordingEvaluator::RecordingEvaluator(const Scene& scene, const ChannelMap& channels,
                                       const std::vector<SceneParameter>& parameters, const CalibrationRecording& data,
                                       const CalibrationOptions& options)
    : scene_(scene), channels_(channels), parameters_(parameters), data_(data), model_(options.model),
      mount_(options.force_sensor), readings_(data.recording) {
  constexpr double kAccuracy = 1e-9;  // leaves 1e-5 of a difference by a thousandth of a prior sigma
  model_.accuracy = std::min(model_.accuracy, kAccuracy);
  if (channels.chamberCount() != scene.chamberCount())
    throw ConfigurationError("channel map", {"feeds " + std::to_string(channels.chamberCount()) + " chambers: must be the "
                                             "scene's " + std::to_string(scene.chamberCount())});
  if (data.recording.channelCount() != channels.channelCount())
    throw ConfigurationError(data.recording.name,
                             {std::to_string(data.recording.channelCount()) + " pressure channels: must be " +
                              std::to_string(channels.channelCount()) + ", as the channel map has"});
  correlation_ = std::max(1.0, options.correlation_time / sampleTime(data.recording));
}

bool RecordingEvaluator::predict(const Eigen::VectorXd& values, bool all, std::vector<Pose>& X_BT) {
  const Scene scene = withParameters(scene_, parameters_, values);
  const ForceSensorMount mount = withParameters(mount_, parameters_, values);
  const StiffnessModel model(scene, model_);
  StiffnessWorkspace workspace = model.makeWorkspace();
  SceneCreep creep(scene);
  X_BT.resize(data_.used.size());
  for (size_t i = 0; i < X_BT.size(); ++i) {
    const double time = data_.recording.samples[i].time;
    const Pressures& effective = creep.update(data_.channels[i], time);
    if (!all && !data_.used[i]) continue;
    const bool pushed = !R_BT_.empty() && data_.loaded[i] && data_.recording.samples[i].tip_wrench;
    const Wrench tip_wrench = pushed ? readings_.atTip(mount, time, R_BT_[i]) : Wrench(Wrench::Zero());
    const StiffnessSolution solution = model.solve(channels_.expand(effective), tip_wrench, workspace);
    if (!solution.status.ok()) {
      failure_ = "sample at " + numberText(time) + " s: " + model.describe(solution.status);
      return false;
    }
    X_BT[i] = solution.X_BT;
  }
  return true;
}

bool RecordingEvaluator::differentiate(const Eigen::VectorXd& values) {
  const std::vector<Pose>& X_BT = predictions_.X_BT;
  predictions_.derivative.resize(X_BT.size());
  for (auto& derivative : predictions_.derivative) derivative.setZero(6, values.size());
  std::vector<Pose> above, below;
  for (size_t k = 0; k < parameters_.size(); ++k) {
    ParameterStep step = stepAbout(values, parameters_, k);
    if (!(step.distance() > 0.0)) continue;
    const bool is_above = predict(step.above, false, above), is_below = predict(step.below, false, below);
    if (!is_above && !is_below) return false;
    // Next to where solutions end, the side that has them counts.
    if (!is_above) above = X_BT, step.above = values;
    if (!is_below) below = X_BT, step.below = values;
    for (size_t i = 0; i < X_BT.size(); ++i) {
      if (!data_.used[i]) continue;
      predictions_.derivative[i].col(static_cast<long>(k)) = residualTwist(above[i], below[i]) / step.distance();
    }
  }
  return true;
}

const TipPredictions* RecordingEvaluator::at(const double* x, bool derivatives) {
  const Eigen::VectorXd values = valuesAt(parameters_, x);
  if (cached_ != values || (derivatives && !cache_has_derivatives_)) {
    cache_ok_ = predict(values, false, predictions_.X_BT) && (!derivatives || differentiate(values));
    cached_ = values;
    cache_has_derivatives_ = derivatives;
  }
  return cache_ok_ ? &predictions_ : nullptr;
}

void RecordingEvaluator::orientTips(const Registration& registration) {
  R_BT_.clear();
  for (const RecordedSample& sample : data_.recording.samples)
    R_BT_.push_back(registration.tipPose(sample.tipPose()).R);
  cached_.reset();
}

Registration RecordingEvaluator::registration(const RegistrationVector& r) const {
  Registration result;
  result.X_AB = {expSo3(r.head<3>()) * start_.X_AB.R, r.segment<3>(3)};
  result.X_TS = {expSo3(r.tail<3>()) * start_.X_TS.R, r.segment<3>(6)};
  return result;
}

const Registration& RecordingEvaluator::restart(const double* x) {
  const TipPredictions* predictions = at(x, false);
  if (predictions == nullptr)
    throw ConfigurationError("calibration of " + data_.recording.name,
                             {"the model has no solution at the start: " + failure()});
  std::vector<Pose> X_BT, X_AS;
  for (size_t i = 0; i < data_.used.size(); ++i) {
    if (!data_.used[i] || data_.loaded[i]) continue;
    X_BT.push_back(predictions->X_BT[i]);
    X_AS.push_back(data_.recording.samples[i].tipPose());
  }
  return start_ = fitRegistration(X_BT, X_AS).registration;
}

}  // namespace live_stiffness
