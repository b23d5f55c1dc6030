#include "calibration/recording_evaluator.h"

#include <algorithm>

#include "estimation/creep.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {
namespace {

// Mean time between poses that are new, s. A gap in which the tracker repeated itself counts as `most` s at most.
double sampleTime(const Recording& recording, double most) {
  double sum = 0.0;
  size_t last = 0;
  int gaps = 0;
  for (size_t i = 1; i < recording.samples.size(); ++i) {
    if (recording.samples[i].unchanged_for > 0.0) continue;
    const double gap = recording.samples[i].time - recording.samples[last].time;
    sum += i > last + 1 ? std::min(gap, most) : gap;
    last = i;
    ++gaps;
  }
  return gaps > 0 ? sum / gaps : 1.0;
}

}  // namespace

RecordingEvaluator::RecordingEvaluator(const Scene& scene, const ChannelMap& channels,
                                       const std::vector<SceneParameter>& parameters, const CalibrationRecording& data,
                                       const CalibrationOptions& options)
    : scene_(scene), channels_(channels), parameters_(parameters), data_(data), model_(options.model),
      mount_(options.force_sensor), readings_(data.recording),
      measures_(data.recording.measures.value_or(TrackerMeasures::kPose)), fitted_(data.used) {
  constexpr double kAccuracy = 1e-9;  // leaves 1e-5 of a difference by a thousandth of a prior sigma
  model_.accuracy = std::min(model_.accuracy, kAccuracy);
  correlation_ = std::max(1.0, options.correlation_time / sampleTime(data.recording, options.correlation_time));
}

bool RecordingEvaluator::predict(const Eigen::VectorXd& values, const std::vector<bool>& which, long most,
                                 std::vector<Pose>& X_BT, std::vector<bool>& solved) {
  const Scene scene = withParameters(scene_, parameters_, values);
  const ForceSensorMount mount = withParameters(mount_, parameters_, values);
  const StiffnessModel model(scene, model_);
  StiffnessWorkspace workspace = model.makeWorkspace();
  SceneCreep creep(scene);
  X_BT.resize(which.size());
  solved.assign(which.size(), false);
  long failed = 0;
  for (size_t i = 0; i < which.size(); ++i) {
    const double time = data_.recording.samples[i].time;
    const Pressures& effective = creep.update(data_.channels[i], time);
    if (!which[i]) continue;
    const bool pushed = !R_BT_.empty() && data_.loaded[i] && data_.recording.samples[i].tip_wrench;
    const Wrench tip_wrench = pushed ? readings_.atTip(mount, time, R_BT_[i]) : Wrench(Wrench::Zero());
    const StiffnessSolution solution = model.solve(channels_.expand(effective), tip_wrench, workspace);
    solved[i] = solution.status.ok();
    if (solved[i]) {
      X_BT[i] = solution.X_BT;
      continue;
    }
    if (failed == 0) failure_ = "sample at " + numberText(time) + " s: " + model.describe(solution.status);
    if (++failed > most) return false;
    workspace = model.makeWorkspace();
  }
  return true;
}

bool RecordingEvaluator::differentiate(const Eigen::VectorXd& values, long most) {
  const std::vector<Pose>& X_BT = predictions_.X_BT;
  predictions_.derivative.resize(X_BT.size());
  for (auto& derivative : predictions_.derivative) derivative.setZero(6, values.size());
  std::vector<Pose> above, below;
  std::vector<bool> is_above, is_below;
  for (size_t k = 0; k < parameters_.size(); ++k) {
    const ParameterStep step = stepAbout(values, parameters_, k);
    if (!(step.distance() > 0.0)) continue;
    long neither = 0;
    if (!predict(step.above, solved_, most, above, is_above)) is_above.assign(X_BT.size(), false);
    if (!predict(step.below, solved_, most, below, is_below)) is_below.assign(X_BT.size(), false);
    for (size_t i = 0; i < X_BT.size(); ++i) {
      if (!is_above[i] && !is_below[i]) {
        neither += solved_[i];
        continue;
      }
      // Next to where solutions end, the side that has them counts.
      const double distance = ((is_above[i] ? step.above : values) - (is_below[i] ? step.below : values)).sum();
      if (!(distance > 0.0)) continue;
      predictions_.derivative[i].col(static_cast<long>(k)) =
          residualTwist(is_above[i] ? above[i] : X_BT[i], is_below[i] ? below[i] : X_BT[i]) / distance;
    }
    if (neither > most) return false;
  }
  return true;
}

const TipPredictions* RecordingEvaluator::at(const double* x, bool derivatives) {
  const Eigen::VectorXd values = valuesAt(parameters_, x);
  if (cached_ != values || (derivatives && !cache_has_derivatives_)) {
    constexpr double kMost = 5.0;  // a sample without a solution takes 0.2 s
    const auto few = static_cast<long>(std::min(kMost, kFewShare * static_cast<double>(fittedCount())));
    cache_ok_ = predict(values, fitted_, few, predictions_.X_BT, solved_) && (!derivatives || differentiate(values, few));
    cached_ = values;
    cache_has_derivatives_ = derivatives;
  }
  return cache_ok_ ? &predictions_ : nullptr;
}

std::vector<bool> RecordingEvaluator::predictAll(const double* x, std::vector<Pose>& X_BT) {
  const std::vector<bool> all(data_.used.size(), true);
  std::vector<bool> solved;
  X_BT.assign(all.size(), Pose());
  predict(valuesAt(parameters_, x), all, static_cast<long>(all.size()), X_BT, solved);
  return solved;
}

bool RecordingEvaluator::chooseFitted(const double* x) {
  const auto most = static_cast<long>(std::max(1.0, kMostShare * static_cast<double>(fittedCount())));
  std::vector<bool> solved;
  cached_.reset();
  if (!predict(valuesAt(parameters_, x), fitted_, most, predictions_.X_BT, solved)) return false;
  fitted_ = solved;
  return true;
}

long RecordingEvaluator::fittedCount() const { return std::count(fitted_.begin(), fitted_.end(), true); }

void RecordingEvaluator::orientTips(const double* x, const Registration& registration) {
  std::vector<Pose> X_BT;
  std::vector<bool> solved(data_.used.size(), false);
  if (measures_ != TrackerMeasures::kPose) solved = predictAll(x, X_BT);
  R_BT_.clear();
  for (size_t i = 0; i < solved.size(); ++i) {
    Pose X_AS = data_.recording.samples[i].tipPose();
    if (solved[i]) X_AS = completedPose(X_AS, registration.sensorPose(X_BT[i]), measures_);
    R_BT_.push_back(registration.tipPose(X_AS).R);
  }
  cached_.reset();
}

Registration RecordingEvaluator::registration(const RegistrationVector& r) const {
  Registration result;
  result.X_AB = {expSo3(r.head<3>()) * start_.X_AB.R, r.segment<3>(3)};
  result.X_TS = {expSo3(r.tail<3>()) * start_.X_TS.R, r.segment<3>(6)};
  return result;
}

void RecordingEvaluator::addPairs(const double* x, std::vector<Pose>& X_BT, std::vector<Pose>& X_AS) {
  const TipPredictions* predictions = at(x, false);
  for (size_t i = 0; predictions != nullptr && i < fitted_.size(); ++i) {
    if (!fitted_[i] || data_.loaded[i]) continue;
    X_BT.push_back(predictions->X_BT[i]);
    X_AS.push_back(data_.recording.samples[i].tipPose());
  }
}

}  // namespace live_stiffness
