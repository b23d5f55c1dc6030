#include "live_stiffness/estimation/tip_wrench_estimator.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "estimation/creep.h"
#include "estimation/tip_wrench_filter.h"

namespace live_stiffness {
namespace {

// Poses farther than this from what is expected are left out, standard deviations: no noise does that, but a tracker that
// takes something else for its sensor does. After so many in a row that agree with one another the robot is there.
constexpr double kGate = 8.0;
constexpr int kReaccept = 5;

const TipWrenchOptions& checked(const TipWrenchOptions& options) {
  FaultList faults("tip wrench estimator");
  faults.checkAll(options);
  options.checkComponents(faults);
  faults.throwIfAny();
  return options;
}

bool isPose(const Pose& X) {
  constexpr double kOrthonormal = 1e-6;
  return X.p.allFinite() && X.R.determinant() > 0.0 &&
         (X.R * X.R.transpose() - Matrix3::Identity()).norm() < kOrthonormal;
}

}  // namespace

const char* codeName(TipWrenchCode code) {
  switch (code) {
    case TipWrenchCode::kOk: return "ok";
    case TipWrenchCode::kInvalidInput: return "invalid_input";
    case TipWrenchCode::kTimeBackwards: return "time_backwards";
    case TipWrenchCode::kRestarted: return "restarted";
    case TipWrenchCode::kOutlier: return "outlier";
    case TipWrenchCode::kSolveFailed: return "solve_failed";
  }
  return "unknown";
}

TipWrenchEstimator::TipWrenchEstimator(const Scene& scene, const ModelOptions& model_options,
                                       const TipWrenchOptions& options)
    : options_(checked(options)),
      filter_(std::make_unique<TipWrenchFilter>(scene, model_options, options_)),
      creep_(std::make_unique<SceneCreep>(scene)) {
  reset();
}

TipWrenchEstimator::~TipWrenchEstimator() = default;

const StiffnessModel& TipWrenchEstimator::model() const { return filter_->model(); }

void TipWrenchEstimator::reset() {
  started_ = has_estimate_ = contact_ = false;
  pending_ = 0.0;
  outliers_ = 0;
  code_ = TipWrenchCode::kOk;
  status_ = {};
  filter_->reset();
  creep_->reset();
}

bool TipWrenchEstimator::setKnownWrench(const Wrench& known) {
  if (!known.allFinite()) return false;
  known_ = known;
  return true;
}

void TipWrenchEstimator::setMeasures(TrackerMeasures measures) {
  filter_->setMeasuresRotation(measures != TrackerMeasures::kPosition);
}

std::string TipWrenchEstimator::statusText() const {
  switch (code_) {
    case TipWrenchCode::kOk: return "";
    case TipWrenchCode::kInvalidInput:
      if (!status_.ok()) return model().describe(status_);
      return "pose or time is not usable: must be finite, the rotation orthonormal; sample left out";
    case TipWrenchCode::kTimeBackwards: return "time does not increase: sample left out";
    case TipWrenchCode::kRestarted: return "time jumped back by more than 1 s: estimation started again";
    case TipWrenchCode::kOutlier:
      return "pose is " + numberText(estimate_.innovation) + " standard deviations from what was expected (gate " +
             numberText(kGate) + "): left out; if it is right, raise the noise parameters or check the registration";
    case TipWrenchCode::kSolveFailed:
      if (!status_.ok()) return model().describe(status_) + "; the last good estimate is kept";
      return "the measurement update broke down; the last good estimate is kept";
  }
  return "unknown";
}

// Refuses what is not usable, and starts again where time jumped back.
bool TipWrenchEstimator::accept(PressuresRef pressures, const Pose* measured, double time) {
  status_ = {};
  code_ = TipWrenchCode::kInvalidInput;
  if (!std::isfinite(time) || (measured != nullptr && !isPose(*measured))) return false;
  status_ = model().checkInput(pressures, known_);
  if (!status_.ok()) return false;
  code_ = TipWrenchCode::kOk;
  if (started_ && time <= time_) {
    const bool restart = time < time_ - kRestartAfter;
    code_ = restart ? TipWrenchCode::kRestarted : TipWrenchCode::kTimeBackwards;
    if (!restart) return false;
    reset();
    code_ = TipWrenchCode::kRestarted;
  }
  if (!started_) {
    pressures_ = pressures;
    time_ = time;
    started_ = true;
  }
  return true;
}

// Beyond the gate, unless the last few agreed with one another: then the robot really is there.
bool TipWrenchEstimator::isOutlier(const Pose& measured, double innovation) {
  if (innovation <= kGate) {
    outliers_ = 0;
    return false;
  }
  const Twist moved = residualTwist(measured, last_outlier_);
  constexpr double kLargestMove = 0.01, kLargestTurn = 0.2;  // m and rad from one sample to the next
  const bool agrees = outliers_ > 0 && linear(moved).norm() < kLargestMove && angular(moved).norm() < kLargestTurn;
  outliers_ = agrees ? outliers_ + 1 : 1;
  last_outlier_ = measured;
  if (outliers_ < kReaccept) return true;
  outliers_ = 0;
  return false;
}

bool TipWrenchEstimator::step(PressuresRef pressures, const Pose* measured, double time) {
  if (!accept(pressures, measured, time)) return false;
  const double elapsed = time - time_;
  const double pressure_change = (pressures - pressures_).norm();
  filter_->setInputs(creep_->update(pressures, time), known_);
  pressures_ = pressures;
  time_ = time;

  const bool contact = contact_;
  TipWrenchFilter::Belief prior = filter_->predicted(elapsed, pressure_change, contact);
  TipWrenchFilter::Correction correction;
  bool outlier = false;
  if (measured != nullptr) {
    bool corrected = filter_->correct(*measured, prior, !contact, correction);
    if (!contact && (!corrected || correction.innovation > TipWrenchFilter::kRobustFrom)) {
      // More than a free robot would do: as if contact had begun.
      const TipWrenchFilter::Belief touched = filter_->predicted(elapsed, pressure_change, true);
      corrected = filter_->correct(*measured, touched, false, correction);
      if (corrected) prior = touched;
    }
    outlier = corrected && isOutlier(*measured, correction.innovation);
    if (!corrected) {
      filter_->accept(prior);
      return fail();
    }
  }
  if (measured == nullptr || outlier) {
    // An outlier tells nothing about contact, so that the robot goes on as it was.
    if (outlier) prior = filter_->predicted(elapsed, pressure_change, contact);
    correction.iterations = 0;
    const bool solved = filter_->solveAt(prior.x, correction.solution);
    filter_->accept(prior);
    if (!solved) return fail();
  } else {
    filter_->accept(correction.posterior);
    updateContact(elapsed);
  }
  estimate_.outlier = outlier;
  estimate_.tracked = measured != nullptr;
  estimate_.innovation = correction.innovation;
  estimate_.iterations = correction.iterations;
  publish(correction.solution, time);
  if (outlier) code_ = TipWrenchCode::kOutlier;
  return true;
}

// The last good estimate is kept.
bool TipWrenchEstimator::fail() {
  status_ = filter_->status();
  code_ = TipWrenchCode::kSolveFailed;
  return false;
}

// Contact begins when the force has been above contact_on_force and well above its standard deviation for a while, and ends
// when it has been below a share of contact_on_force, or within its deviation, for a little longer. elapsed: s.
void TipWrenchEstimator::updateContact(double elapsed) {
  constexpr double kOffShare = 0.6;  // of contact_on_force, so that a force at the threshold does not flicker
  constexpr double kOnDeviations = 3.0, kOffDeviations = 1.0;  // so that an uncertain force is no contact
  constexpr double kOnTime = 0.1, kOffTime = 0.3;              // s; longer than an outlier lasts
  constexpr double kRounding = 1e-9;                           // of sums of sample times, s
  const Vector3 force = linear(filter_->wrench());
  const Matrix3 covariance = filter_->wrenchCovariance().topLeftCorner<3, 3>();
  const double size = force.norm(), on = options_.contact_on_force;
  const double variance = size > 0.0 ? force.dot(covariance * force) / (size * size) : covariance(0, 0);
  const double deviation = std::sqrt(std::max(variance, 0.0));
  const bool asks_for_change = contact_ ? size < kOffShare * on || size < kOffDeviations * deviation
                                        : size > on && size > kOnDeviations * deviation;
  pending_ = asks_for_change ? pending_ + elapsed : 0.0;
  if (!asks_for_change || pending_ < (contact_ ? kOffTime : kOnTime) - kRounding) return;
  contact_ = !contact_;
  pending_ = 0.0;
}

void TipWrenchEstimator::publish(const StiffnessSolution& solution, double time) {
  estimate_.time = time;
  estimate_.wrench = filter_->wrench();
  estimate_.covariance = filter_->wrenchCovariance();
  estimate_.stiffness_scale = filter_->stiffnessScale();
  estimate_.stiffness_scale_deviation = filter_->stiffnessScaleDeviation();
  estimate_.contact = contact_;
  estimate_.X_BT = filter_->withModelError(solution.X_BT, filter_->belief().x);
  estimate_.model_error = filter_->modelError();
  estimate_.solution = solution;
  has_estimate_ = true;
}

bool TipWrenchEstimator::update(PressuresRef gauge_pressures, const Pose& measured_X_BT, double time) {
  return step(gauge_pressures, &measured_X_BT, time);
}

bool TipWrenchEstimator::predict(PressuresRef gauge_pressures, double time) {
  return step(gauge_pressures, nullptr, time);
}

}  // namespace live_stiffness
