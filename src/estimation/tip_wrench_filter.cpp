#include "estimation/tip_wrench_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace live_stiffness {
namespace {

// Without contact the wrench is small and soon forgotten, so that what lasts counts as model error.
constexpr double kFreeForce = 0.05, kFreeMoment = 1e-3;  // N and N m
constexpr double kFreeTime = 0.5;                        // s
// In contact it walks freely up to the size that is expected: a force within some 1/25 s. A moment is that of such a
// force at a short lever, since most that touches a tip touches it with a point.
constexpr double kForceWalk = 5.0, kMomentWalk = 1.5;  // 1 / sqrt(s), of the size
constexpr double kContactLever = 1.0 / 30.0;           // m
// The model error outlasts any contact, so that a push that lasts does not turn into it; without contact it is free to
// follow creep. Each change of pressure, by its 2-norm over the chambers, adds to it what the model may get wrong of it.
constexpr double kErrorTime = 2.0, kErrorTimeInContact = 100.0;  // s
constexpr double kErrorPositionPerPressure = 2e-8;               // m/Pa
constexpr double kErrorRotationPerPressure = 5e-5 * kDegree;     // rad/Pa
// Models are made again when the logarithm of the scale has changed by more than this; until then they err by at most 1e-3
// of the deflection. The difference for the derivative by the logarithm truncates 1 % of it.
constexpr double kRebuildAfter = 1e-3, kScaleDifference = 1e-2;
constexpr double kScaleWalk = 0.002;  // 1 / sqrt(s), of the logarithm of the stiffness scale: warming up takes minutes

// Gauss-Markov process over `elapsed`: the value decays by the factor, and its variance tends to sigma^2.
void relax(double& value, double& factor, double& noise, double sigma, double time, double elapsed) {
  factor = std::exp(-elapsed / time);
  noise = sigma * sigma * (1.0 - factor * factor);
  value *= factor;
}

}  // namespace

TipWrenchFilter::TipWrenchFilter(Scene scene, const ModelOptions& model_options, const TipWrenchOptions& options)
    : options_(options), scene_(std::move(scene)), model_options_(model_options) {
  reset();
}

void TipWrenchFilter::reset() {
  const int size = options_.components + 7;
  State& x = belief_.x;
  StateMatrix& P = belief_.P;
  x = State::Zero(size);
  P = StateMatrix::Zero(size, size);
  for (int k = 0; k < options_.components; ++k)
    P(k, k) = std::pow(k < 3 ? kFreeForce : kFreeMoment, 2);
  P(scaleIndex(), scaleIndex()) = std::pow(options_.scale_deviation, 2);
  for (int k = 0; k < 6; ++k)
    P(biasIndex() + k, biasIndex() + k) = std::pow(modelErrorSize(k), 2);
  status_ = {};
  setLogScale(0.0);
}

void TipWrenchFilter::setLogScale(double log_scale) {
  if (scaled_ && std::abs(log_scale - log_scale_) <= kRebuildAfter) return;
  const auto solverAt = [&](double log) {
    Scene scene = scene_;
    for (Body& body : scene.chain) {
      auto* const segment = std::get_if<Segment>(&body);
      if (segment == nullptr) continue;
      segment->section.youngs_modulus *= std::exp(log);
      segment->section.shear_modulus *= std::exp(log);
    }
    return std::make_unique<Solver>(std::move(scene), model_options_);
  };
  scaled_ = solverAt(log_scale);
  if (options_.scale_deviation > 0.0) stiffer_ = solverAt(log_scale + kScaleDifference);
  log_scale_ = log_scale;
}

void TipWrenchFilter::setInputs(PressuresRef effective, const Wrench& known) {
  effective_ = effective;
  known_ = known;
  if (options_.scale_deviation > 0.0) setLogScale(belief_.x[scaleIndex()]);
}

Wrench TipWrenchFilter::wrenchOf(const State& x) const {
  Wrench wrench = Wrench::Zero();
  wrench.head(options_.components) = x.head(options_.components);
  return wrench;
}

Matrix6 TipWrenchFilter::wrenchCovariance() const {
  const int n = options_.components;
  Matrix6 covariance = Matrix6::Zero();
  covariance.topLeftCorner(n, n) = belief_.P.topLeftCorner(n, n);
  return covariance;
}

double TipWrenchFilter::stiffnessScale() const { return std::exp(belief_.x[scaleIndex()]); }

double TipWrenchFilter::stiffnessScaleDeviation() const {
  return stiffnessScale() * std::sqrt(std::max(belief_.P(scaleIndex(), scaleIndex()), 0.0));
}

Pose TipWrenchFilter::withModelError(const Pose& X_BT, const State& x) const {
  const Twist b = x.segment<6>(biasIndex());
  return {expSo3(b.tail<3>()) * X_BT.R, X_BT.p + b.head<3>()};
}

TipWrenchFilter::Belief TipWrenchFilter::predicted(double elapsed, double pressure_change, bool contact) const {
  Belief next = belief_;
  const int size = static_cast<int>(next.x.size());
  State factor = State::Ones(size), noise = State::Zero(size);
  for (int k = 0; k < options_.components; ++k) {
    const double largest = options_.contact_force * (k < 3 ? 1.0 : kContactLever);
    const double walk = k < 3 ? kForceWalk : kMomentWalk;
    // A process of size sigma and rate q sigma forgets in 2 / q^2.
    if (contact) relax(next.x[k], factor[k], noise[k], largest, 2.0 / (walk * walk), elapsed);
    else relax(next.x[k], factor[k], noise[k], k < 3 ? kFreeForce : kFreeMoment, kFreeTime, elapsed);
  }
  if (options_.scale_deviation > 0.0 && !contact)
    noise[scaleIndex()] = kScaleWalk * kScaleWalk * elapsed;
  for (int k = 0; k < 6; ++k) {
    const int i = biasIndex() + k;
    relax(next.x[i], factor[i], noise[i], modelErrorSize(k), contact ? kErrorTimeInContact : kErrorTime, elapsed);
    const double rate = k < 3 ? kErrorPositionPerPressure : kErrorRotationPerPressure;
    noise[i] += std::pow(rate * pressure_change, 2);
  }
  next.P = factor.asDiagonal() * belief_.P * factor.asDiagonal();
  next.P.diagonal() += noise;
  return next;
}

bool TipWrenchFilter::solveAt(const State& x, StiffnessSolution& solution) {
  solution = scaled_->model.solve(effective_, wrenchOf(x) + known_, scaled_->workspace);
  status_ = solution.status;
  return status_.ok();
}

TipWrenchFilter::Design TipWrenchFilter::designAt(const State& x, const StiffnessSolution& solution) {
  Design H = Design::Zero(6, x.size());
  H.leftCols(options_.components) = solution.compliance.leftCols(options_.components);
  if (stiffer_) {
    const StiffnessSolution stiffer = stiffer_->model.solve(effective_, wrenchOf(x) + known_, stiffer_->workspace);
    if (stiffer.status.ok()) H.col(scaleIndex()) = residualTwist(stiffer.X_BT, solution.X_BT) / kScaleDifference;
  }
  H.middleCols<6>(biasIndex()).setIdentity();
  return H;
}

double TipWrenchFilter::moveBy(const State& step, State& x, StiffnessSolution& solution) {
  double share = 1.0;
  for (int tries = 0; tries < 4; ++tries, share *= 0.5) {
    const State next = x + share * step;
    if (!next.allFinite() || !solveAt(next, solution)) continue;
    x = next;
    return share;
  }
  return 0.0;
}

// Weights come from the first innovation, so that the iteration has one goal.
bool TipWrenchFilter::correct(const Pose& measured, const Belief& prior, bool learn_scale, Correction& result) {
  const int size = static_cast<int>(prior.x.size());
  Vector6 noise;
  constexpr double kNotMeasured = 1e3;  // rad
  noise << Vector3::Constant(std::pow(options_.position_noise, 2)),
      Vector3::Constant(std::pow(measures_rotation_ ? options_.rotation_noise : kNotMeasured, 2));
  State x = prior.x;
  if (!solveAt(x, result.solution)) return false;
  double weight = 1.0;
  for (result.iterations = 1; result.iterations <= TipWrenchEstimator::kMaxIterations; ++result.iterations) {
    const Twist residual = residualTwist(measured, withModelError(result.solution.X_BT, x));
    const Design H = designAt(x, result.solution);
    const Twist predicted = residual + H * (x - prior.x);  // innovation about the prior, linearised here
    const Design HP = H * prior.P;
    Matrix6 S = HP * H.transpose();
    if (result.iterations == 1) {
      Matrix6 plain = S;
      plain.diagonal() += noise;
      const Vector6 weighted = plain.llt().solve(predicted);
      result.innovation = std::sqrt(predicted.dot(weighted));
      weight = std::max(1.0, result.innovation / kRobustFrom);
    }
    S.diagonal() += weight * noise;
    Design gain = S.llt().solve(HP);  // transposed
    if (!learn_scale) gain.col(scaleIndex()).setZero();
    const State step = prior.x + gain.transpose() * predicted - x;
    const double share = moveBy(step, x, result.solution);
    if (share == 0.0) return false;
    const Twist moved = H * (share * step);
    const bool settled = (moved.array().square() < 1e-6 * noise.array()).all();  // 1e-3 of the tracker's noise
    if (!settled && result.iterations < TipWrenchEstimator::kMaxIterations) continue;
    // Joseph's form: right for any gain, so also with the scale held.
    const StateMatrix A = StateMatrix::Identity(size, size) - gain.transpose() * H;
    StateMatrix& P = result.posterior.P;
    result.posterior.x = x;
    P = A * prior.P * A.transpose() + gain.transpose() * (weight * noise).asDiagonal() * gain;
    P = (0.5 * (P + P.transpose())).eval();
    return x.allFinite() && P.allFinite();
  }
  return false;
}

}  // namespace live_stiffness
