#include "calibration/recording_evaluator.h"

#include <algorithm>

#include "live_stiffness/checks.h"
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
    : predictor_(scene, options.model, channels, parameters), data_(data), mount_(options.force_sensor),
      readings_(data.recording) {
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
    const ForceSensorMount mount = withParameters(mount_, predictor_.parameters(), values);
    placeWrenches(mount, samples_);
    cache_ok_ = predictor_.predict(values, samples_, derivatives, predictions_);
    for (size_t i = 0; cache_ok_ && derivatives && i < samples_.size(); ++i)
      if (isPushed(i) && samples_[i].wanted)
        predictions_[i].derivative += predictions_[i].compliance *
                                      readings_.derivative(mount, predictor_.parameters(), samples_[i].time, R_BT_[i]);
    cached_ = values;
    has_cache_ = true;
    cache_has_derivatives_ = derivatives;
  }
  return cache_ok_ ? &predictions_ : nullptr;
}

bool RecordingEvaluator::predictAll(const double* x, std::vector<TipPrediction>& predictions) {
  std::vector<ActuationSample> samples = samples_;
  for (ActuationSample& sample : samples) sample.wanted = true;
  const Eigen::VectorXd values = valuesAt(predictor_.parameters(), x);
  placeWrenches(withParameters(mount_, predictor_.parameters(), values), samples);
  return predictor_.predict(values, samples, false, predictions);
}

void RecordingEvaluator::orientTips(const Registration& registration) {
  R_BT_.clear();
  for (const RecordedSample& sample : data_.recording.samples)
    R_BT_.push_back(registration.tipPose(sample.tipPose()).R);
  has_cache_ = false;
}

void RecordingEvaluator::placeWrenches(const ForceSensorMount& mount, std::vector<ActuationSample>& samples) const {
  for (size_t i = 0; i < samples.size(); ++i)
    if (isPushed(i)) samples[i].tip_wrench = readings_.atTip(mount, samples[i].time, R_BT_[i]);
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

}  // namespace live_stiffness
