#include "live_stiffness/estimation/tip_wrench_estimator.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace live_stiffness {
namespace {

const Material& firstMaterial(const Scene& scene) {
  for (const Body& body : scene.chain)
    if (const auto* segment = std::get_if<Segment>(&body)) return segment->section.material;
  throw ConfigurationError("tip wrench estimator", {"chain: must hold at least one segment"});
}

const TipWrenchOptions& checked(const TipWrenchOptions& options) {
  FaultList faults("tip wrench estimator");
  options.check(faults);
  faults.throwIfAny();
  return options;
}

bool isPose(const Pose& X) {
  constexpr double kOrthonormal = 1e-6;
  return X.p.allFinite() && X.R.allFinite() && X.R.determinant() > 0.0 &&
         (X.R * X.R.transpose() - Matrix3::Identity()).norm() < kOrthonormal;
}

// Gauss-Markov process over `elapsed`: the value decays by the factor, and its variance tends to sigma^2.
void relax(double& value, double& factor, double& noise, double sigma, double time, double elapsed) {
  factor = std::exp(-elapsed / time);
  noise = sigma * sigma * (1.0 - factor * factor);
  value *= factor;
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

TipWrenchEstimator::TipWrenchEstimator(Scene scene, const ModelOptions& model_options, const TipWrenchOptions& options)
    : options_(checked(options)),
      model_(scene, model_options, options.scale_deviation > 0.0),
      creep_(firstMaterial(scene).creep_share, firstMaterial(scene).creep_time),
      contact_(options.contact) {
  reset();
}

void TipWrenchEstimator::reset() {
  started_ = has_estimate_ = false;
  outliers_ = 0;
  code_ = TipWrenchCode::kOk;
  status_ = {};
  model_.setLogScale(0.0);
}

bool TipWrenchEstimator::setKnownWrench(const Wrench& known) {
  if (!known.allFinite()) return false;
  known_ = known;
  return true;
}

std::string TipWrenchEstimator::statusText() const {
  switch (code_) {
    case TipWrenchCode::kOk: return "";
    case TipWrenchCode::kInvalidInput:
      if (!status_.ok()) return model().describe(status_);
      return "pose or time is not usable: must be finite, the rotation orthonormal; sample left out";
    case TipWrenchCode::kTimeBackwards: return "time does not increase: sample left out";
    case TipWrenchCode::kRestarted: return "time jumped back by more than 1 s: estimation began anew";
    case TipWrenchCode::kOutlier:
      return "pose is " + numberText(estimate_.innovation) + " standard deviations from what was expected (gate " +
             numberText(options_.gate) + "): left out; if it is right, raise the noise parameters or check the registration";
    case TipWrenchCode::kSolveFailed:
      if (!status_.ok()) return model().describe(status_) + "; the last good estimate is kept";
      return "the measurement update broke down; the last good estimate is kept";
  }
  return "unknown";
}

Wrench TipWrenchEstimator::wrenchOf(const State& x) const {
  Wrench wrench = Wrench::Zero();
  wrench.head(options_.components) = x.head(options_.components);
  return wrench;
}

Pose TipWrenchEstimator::withModelError(const Pose& X_BT, const State& x) const {
  const Twist b = x.segment<6>(biasIndex());
  return {expSo3(b.tail<3>()) * X_BT.R, X_BT.p + b.head<3>()};
}

// Refuses what is not usable, and begins anew where time jumped back.
bool TipWrenchEstimator::accept(PressuresRef pressures, double time) {
  status_ = {};
  code_ = TipWrenchCode::kInvalidInput;
  if (!std::isfinite(time)) return false;
  if (pressures.size() != model().scene().chamberCount()) {
    status_ = {SolveCode::kInvalidInput, -1, static_cast<double>(pressures.size())};
    return false;
  }
  for (int k = 0; k < pressures.size(); ++k)
    if (!std::isfinite(pressures[k]) || pressures[k] < -kAtmospherePa) {
      status_ = {SolveCode::kInvalidInput, k, pressures[k]};
      return false;
    }
  code_ = TipWrenchCode::kOk;
  if (started_ && time <= time_) {
    const bool restart = time < time_ - kRestartAfter;
    code_ = restart ? TipWrenchCode::kRestarted : TipWrenchCode::kTimeBackwards;
    if (!restart) return false;
    reset();
    code_ = TipWrenchCode::kRestarted;
  }
  if (!started_) {
    begin();
    pressures_ = pressures;
    time_ = time;
  }
  return true;
}

// Without contact, at the stationary variances.
void TipWrenchEstimator::begin() {
  const int size = options_.components + 7;
  x_ = State::Zero(size);
  P_ = StateMatrix::Zero(size, size);
  for (int k = 0; k < options_.components; ++k)
    P_(k, k) = std::pow(k < 3 ? options_.free_force : options_.free_moment, 2);
  P_(scaleIndex(), scaleIndex()) = std::pow(options_.scale_deviation, 2);
  for (int k = 0; k < 6; ++k)
    P_(biasIndex() + k, biasIndex() + k) = std::pow(k < 3 ? options_.bias_position : options_.bias_rotation, 2);
  contact_.reset();
  creep_.reset();
  outliers_ = 0;
  started_ = true;
}

TipWrenchEstimator::Prediction TipWrenchEstimator::predictState(double elapsed, double pressure_change,
                                                                bool contact) const {
  Prediction next{x_, P_};
  const int size = static_cast<int>(x_.size());
  State factor = State::Ones(size), noise = State::Zero(size);
  for (int k = 0; k < options_.components; ++k) {
    const double walk = k < 3 ? options_.force_walk : options_.moment_walk;
    const double largest = k < 3 ? options_.contact_force : options_.contact_moment;
    const double free = k < 3 ? options_.free_force : options_.free_moment;
    // A process of size sigma and rate q forgets in 2 sigma^2 / q^2.
    if (contact) relax(next.x[k], factor[k], noise[k], largest, 2.0 * std::pow(largest / walk, 2), elapsed);
    else relax(next.x[k], factor[k], noise[k], free, options_.free_time, elapsed);
  }
  if (options_.scale_deviation > 0.0 && !contact)
    noise[scaleIndex()] = options_.scale_walk * options_.scale_walk * elapsed;
  for (int k = 0; k < 6; ++k) {
    const int i = biasIndex() + k;
    relax(next.x[i], factor[i], noise[i], k < 3 ? options_.bias_position : options_.bias_rotation,
          contact ? options_.bias_time_in_contact : options_.bias_time, elapsed);
    const double rate = k < 3 ? options_.bias_position_per_pressure : options_.bias_rotation_per_pressure;
    noise[i] += std::pow(rate * pressure_change, 2);
  }
  next.P = factor.asDiagonal() * P_ * factor.asDiagonal();
  next.P.diagonal() += noise;
  return next;
}

bool TipWrenchEstimator::solveAt(const State& x, StiffnessSolution& solution) {
  solution = model_.solve(effective_, wrenchOf(x) + known_);
  status_ = solution.status;
  return status_.ok();
}

// Iterated update: Gauss-Newton on the state, weights from the first innovation. Where the model has no solution at an
// iterate the step towards it is halved.
bool TipWrenchEstimator::correct(const Pose& measured, const Prediction& prior, bool learn_scale, Correction& result) {
  const int size = static_cast<int>(prior.x.size());
  Vector6 noise;
  noise << Vector3::Constant(std::pow(options_.tracker.position, 2)),
      Vector3::Constant(std::pow(options_.tracker.rotation, 2));
  State x = prior.x;
  if (!solveAt(x, result.solution)) return false;
  double weight = 1.0;
  for (result.iterations = 1; result.iterations <= kMaxIterations; ++result.iterations) {
    const Pose expected = withModelError(result.solution.X_BT, x);
    const Twist residual = residualTwist(measured, expected);
    Design H = Design::Zero(6, size);
    H.leftCols(options_.components) = result.solution.compliance.leftCols(options_.components);
    if (options_.scale_deviation > 0.0)
      H.col(scaleIndex()) = model_.derivative(effective_, wrenchOf(x) + known_, result.solution.X_BT);
    H.middleCols<6>(biasIndex()).setIdentity();
    const Twist predicted = residual + H * (x - prior.x);  // innovation about the prior, linearised here
    const Design HP = H * prior.P;
    Matrix6 S = HP * H.transpose();
    if (result.iterations == 1) {
      Matrix6 plain = S;
      plain.diagonal() += noise;
      result.innovation = std::sqrt(predicted.dot(plain.llt().solve(predicted)));
      weight = std::max(1.0, result.innovation / options_.robust_from);
    }
    S.diagonal() += weight * noise;
    Design gain = S.llt().solve(HP);  // transposed
    if (!learn_scale) gain.col(scaleIndex()).setZero();
    const State step = prior.x + gain.transpose() * predicted - x;
    State next;
    double share = 1.0;
    for (;; share *= 0.5) {
      next = x + share * step;
      if (share < 0.1) return false;  // bounded work: four tries
      if (next.allFinite() && solveAt(next, result.solution)) break;
    }
    x = next;
    const Twist moved = H * (share * step);
    const bool settled = (moved.array().square() < 1e-6 * noise.array()).all();  // 1e-3 of the tracker's noise
    if (settled || result.iterations == kMaxIterations) {
      // Joseph's form: right for any gain, so also with the scale held.
      StateMatrix A = StateMatrix::Identity(size, size) - gain.transpose() * H;
      result.posterior.x = x;
      result.posterior.P = A * prior.P * A.transpose() +
                           gain.transpose() * (weight * noise).asDiagonal() * gain;
      result.posterior.P = (0.5 * (result.posterior.P + result.posterior.P.transpose())).eval();
      return result.posterior.x.allFinite() && result.posterior.P.allFinite();
    }
  }
  return false;
}

// Beyond the gate, unless the last few agreed with one another: then the robot really is there.
bool TipWrenchEstimator::isOutlier(const Pose& measured, double innovation) {
  if (innovation <= options_.gate) {
    outliers_ = 0;
    return false;
  }
  const Twist moved = residualTwist(measured, last_outlier_);
  constexpr double kLargestMove = 0.01, kLargestTurn = 0.2;  // m and rad from one sample to the next
  const bool agrees = outliers_ > 0 && moved.head<3>().norm() < kLargestMove && moved.tail<3>().norm() < kLargestTurn;
  outliers_ = agrees ? outliers_ + 1 : 1;
  last_outlier_ = measured;
  if (outliers_ < options_.reaccept) return true;
  outliers_ = 0;
  return false;
}

bool TipWrenchEstimator::step(PressuresRef pressures, const Pose* measured, double time) {
  if (measured != nullptr && !(measured->p.allFinite() && isPose(*measured))) {
    status_ = {};
    code_ = TipWrenchCode::kInvalidInput;
    return false;
  }
  if (!accept(pressures, time)) return false;
  const double elapsed = time - time_;
  const double pressure_change = (pressures - pressures_).norm();
  effective_ = creep_.update(pressures, elapsed);
  pressures_ = pressures;
  time_ = time;
  if (options_.scale_deviation > 0.0) model_.setLogScale(x_[scaleIndex()]);

  const bool contact = contact_.inContact();
  Prediction prior = predictState(elapsed, pressure_change, contact);
  Correction correction;
  bool outlier = false;
  if (measured != nullptr) {
    bool corrected = correct(*measured, prior, !contact, correction);
    if (!contact && (!corrected || correction.innovation > options_.robust_from)) {
      // More than a free robot would do: as if contact had begun.
      Prediction touched = predictState(elapsed, pressure_change, true);
      corrected = correct(*measured, touched, false, correction);
      if (corrected) prior = touched;
    }
    outlier = corrected && isOutlier(*measured, correction.innovation);
    if (!corrected) {
      const SolveStatus why = status_;
      x_ = prior.x;
      P_ = prior.P;
      code_ = TipWrenchCode::kSolveFailed;
      status_ = why;
      return false;
    }
  }
  const bool predicted_only = measured == nullptr || outlier;
  if (predicted_only) {
    // An outlier tells nothing about contact, so that the robot goes on as it was.
    if (outlier) prior = predictState(elapsed, pressure_change, contact);
    correction.iterations = 0;
    x_ = prior.x;
    P_ = prior.P;
    if (!solveAt(x_, correction.solution)) {
      code_ = TipWrenchCode::kSolveFailed;
      return false;
    }
  } else {
    x_ = correction.posterior.x;
    P_ = correction.posterior.P;
    const Vector3 force = x_.head<3>();
    const double size = force.norm();
    const double variance = size > 0.0 ? force.dot(P_.topLeftCorner<3, 3>() * force) / (size * size) : P_(0, 0);
    contact_.update(size, std::sqrt(std::max(variance, 0.0)), elapsed);
  }
  estimate_.outlier = outlier;
  estimate_.tracked = measured != nullptr;
  estimate_.innovation = correction.innovation;
  estimate_.iterations = correction.iterations;
  publish(correction.solution, time);
  if (outlier) code_ = TipWrenchCode::kOutlier;
  return true;
}

void TipWrenchEstimator::publish(const StiffnessSolution& solution, double time) {
  const int n = options_.components, g = scaleIndex();
  estimate_.time = time;
  estimate_.wrench = wrenchOf(x_);
  estimate_.covariance.setZero();
  estimate_.covariance.topLeftCorner(n, n) = P_.topLeftCorner(n, n);
  estimate_.stiffness_scale = std::exp(x_[g]);
  estimate_.stiffness_scale_deviation = estimate_.stiffness_scale * std::sqrt(std::max(P_(g, g), 0.0));
  estimate_.contact = contact_.inContact();
  estimate_.X_BT = withModelError(solution.X_BT, x_);
  estimate_.model_error = x_.segment<6>(biasIndex());
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
