#include "estimation/tip_wrench_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace live_stiffness {
namespace {

// Gauss-Markov process over `elapsed`: the value decays by the factor, and its variance tends to sigma^2.
void relax(double& value, double& factor, double& noise, double sigma, double time, double elapsed) {
  factor = std::exp(-elapsed / time);
  noise = sigma * sigma * (1.0 - factor * factor);
  value *= factor;
}

}  // namespace

TipWrenchFilter::TipWrenchFilter(Scene scene, const ModelOptions& model_options, const TipWrenchOptions& options)
    : options_(options), model_(std::move(scene), model_options, options.scale_deviation > 0.0) {
  reset();
}

void TipWrenchFilter::reset() {
  const int size = options_.components + 7;
  State& x = belief_.x;
  StateMatrix& P = belief_.P;
  x = State::Zero(size);
  P = StateMatrix::Zero(size, size);
  for (int k = 0; k < options_.components; ++k)
    P(k, k) = std::pow(k < 3 ? options_.free_force : options_.free_moment, 2);
  P(scaleIndex(), scaleIndex()) = std::pow(options_.scale_deviation, 2);
  for (int k = 0; k < 6; ++k)
    P(biasIndex() + k, biasIndex() + k) = std::pow(k < 3 ? options_.bias_position : options_.bias_rotation, 2);
  status_ = {};
  model_.setLogScale(0.0);
}

void TipWrenchFilter::setInputs(PressuresRef effective, const Wrench& known) {
  effective_ = effective;
  known_ = known;
  if (options_.scale_deviation > 0.0) model_.setLogScale(belief_.x[scaleIndex()]);
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
  next.P = factor.asDiagonal() * belief_.P * factor.asDiagonal();
  next.P.diagonal() += noise;
  return next;
}

bool TipWrenchFilter::solveAt(const State& x, StiffnessSolution& solution) {
  solution = model_.solve(effective_, wrenchOf(x) + known_);
  status_ = solution.status;
  return status_.ok();
}

TipWrenchFilter::Design TipWrenchFilter::designAt(const State& x, const StiffnessSolution& solution) {
  Design H = Design::Zero(6, x.size());
  H.leftCols(options_.components) = solution.compliance.leftCols(options_.components);
  if (options_.scale_deviation > 0.0)
    H.col(scaleIndex()) = model_.derivative(effective_, wrenchOf(x) + known_, solution.X_BT);
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
  noise << Vector3::Constant(std::pow(options_.tracker.position, 2)),
      Vector3::Constant(std::pow(options_.tracker.rotation, 2));
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
      weight = std::max(1.0, result.innovation / options_.robust_from);
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
