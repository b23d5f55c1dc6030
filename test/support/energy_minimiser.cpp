#include "support/energy_minimiser.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/errors.h"

namespace live_stiffness {
namespace {

// Smallest eigenvalue of E'' relative to the material's, to 2 %: it is where E'' - x material stops being positive.
double leastStiffness(const EnergyDerivatives& at) {
  const auto is_below = [&](double x) { return BlockCholesky(at.second.plus(-x, at.material)).isPositive(); };
  double low = -1e-9, high = 1e-9, step = 2e-9;
  while (!is_below(low)) high = low, low -= (step *= 16.0);
  while (is_below(high)) low = high, high += (step *= 16.0);
  while (high - low > 0.02 * std::abs(high + low) + 1e-11) (is_below(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

// The way down from a saddle, its largest turn 1 rad: inverse iteration just below that eigenvalue.
NodeVectors softestTurns(const EnergyDerivatives& at, double least_stiffness) {
  const BlockCholesky factor(at.second.plus(-least_stiffness + 0.1 * std::abs(least_stiffness), at.material));
  NodeVectors x(at.gradient.size());
  for (size_t i = 0; i < x.size(); ++i) x[i] = Vector3(1.0 + std::sin(2.0 * i), std::cos(3.0 * i), std::sin(5.0 * i));
  for (int i = 0; i < 20; ++i) {
    x = factor.solve(at.material.times(x));
    x = scaled(1.0 / largestNorm(x), x);
  }
  return dot(x, at.gradient) > 0.0 ? scaled(-1.0, x) : x;
}

// Newton's, or towards it where the energy is not convex.
NodeVectors stepDown(const EnergyDerivatives& at) {
  BlockCholesky factor(at.second);
  for (double shift = 1e-6; !factor.isPositive(); shift *= 4.0) {
    if (shift > 1e12) throw std::runtime_error("the energy is not finite");
    factor = BlockCholesky(at.second.plus(shift, at.material));
  }
  return scaled(-1.0, factor.solve(at.gradient));
}

}  // namespace

std::vector<RestState> restStates(const Scene& scene, PressuresRef pressures, const ModelOptions& options) {
  const int steps = stepCount(pressures.cwiseAbs().maxCoeff(), options.pressure_step);
  std::vector<RestState> rest;
  Eigen::Index first = 0;
  walk(
      scene,
      [&](int, const Segment& segment) {
        const LoadStepper stepper(segment.section);
        rest.push_back(stepper.restState(pressures.segment(first, stepper.chamberCount()), options.stepping, steps));
        first += stepper.chamberCount();
      },
      [](const Link&) {});
  return rest;
}

EnergyMinimum minimiseEnergy(const Scene& scene, const std::vector<RestState>& rest, const Wrench& tip_wrench, int n,
                             const std::optional<NodeRotations>& start) {
  if (!angular(tip_wrench).isZero(0.0)) throw std::invalid_argument("a dead tip moment has no potential");
  constexpr int kMostSteps = 3000, kMostPushes = 30;
  constexpr int kLastSteps = 2;         // by which the energy changes less than its rounding: quadratic convergence
  constexpr double kLongestTurn = 0.5;  // in one step, rad
  constexpr double kLargestResidual = 1e-8;
  const ChainEnergy energy(scene, rest, linear(tip_wrench), n);
  EnergyMinimum at;
  at.nodes = start ? *start : energy.unloaded();
  EnergyDerivatives derivatives = energy.derivatives(at.nodes);
  for (int last_steps = 0, pushes = 0; at.iterations < kMostSteps; ++at.iterations) {
    double uncertainty = 0.0;
    at.energy = energy.value(at.nodes, &uncertainty);
    NodeVectors step = stepDown(derivatives);
    double share = std::min(1.0, kLongestTurn / largestNorm(step)), slope = dot(step, derivatives.gradient);
    bool is_visible = -share * slope > uncertainty;
    if (!is_visible && ++last_steps > kLastSteps) {
      at.least_stiffness = leastStiffness(derivatives);
      if (at.least_stiffness >= -EnergyMinimum::kNeutral || ++pushes > kMostPushes) break;
      step = softestTurns(derivatives, at.least_stiffness);
      share = kLongestTurn, slope = 0.0, is_visible = true, last_steps = 0;
    }
    const auto is_up = [&] { return energy.value(turned(at.nodes, share, step)) > at.energy + 1e-4 * share * slope; };
    while (is_visible && share > 1e-9 && is_up()) share *= 0.5;
    if (share <= 1e-9) ++last_steps;
    at.nodes = turned(at.nodes, share, step);
    derivatives = energy.derivatives(at.nodes);
  }
  at.residual = largestNorm(BlockCholesky(derivatives.material).solve(derivatives.gradient));
  at.converged = at.iterations < kMostSteps && at.residual < kLargestResidual;
  at.base_moment = -derivatives.gradient[0];
  const ChainPlacement placement = energy.place(at.nodes);
  at.X_BT = placement.X_BT;
  at.joints = placement.joints;
  const BlockCholesky second(derivatives.second);
  if (!at.isStable() || !second.isPositive()) return at;
  at.compliance.topLeftCorner<3, 3>() = placement.give;
  const NodeBlocks<6>& by_wrench = placement.by_wrench;
  const NodeBlocks<6> turns = second.solve(by_wrench);
  for (size_t i = 1; i < turns.size(); ++i) at.compliance += by_wrench[i].transpose() * turns[i];
  return at;
}

ExtrapolatedMinimum extrapolatedMinimum(const Scene& scene, const std::vector<RestState>& rest, const Wrench& tip_wrench,
                                        int n, std::optional<NodeRotations> start) {
  std::vector<EnergyMinimum> levels;
  for (int level = 0; level < 3; ++level) {
    levels.push_back(minimiseEnergy(scene, rest, tip_wrench, n << level, start));
    start.emplace(1, Matrix3::Identity());
    const NodeRotations& R = levels.back().nodes;
    for (size_t i = 0; i + 1 < R.size(); ++i) {
      start->push_back(R[i] * expSo3(0.5 * logSo3(R[i].transpose() * R[i + 1])));
      start->push_back(R[i + 1]);
    }
  }
  const double length = scene.length();
  const EnergyMinimum& finest = levels.back();
  using Values = Eigen::Matrix<double, 6, 7>;  // twist from the finest tip to that of a level; compliance
  Values values[3];
  for (int level = 0; level < 3; ++level)
    values[level] << residualTwist(levels[level].X_BT, finest.X_BT), levels[level].compliance;
  const Values once = (4.0 * values[1] - values[0]) / 3.0, again = (4.0 * values[2] - values[1]) / 3.0;
  const Values twice = (16.0 * again - once) / 15.0;
  ExtrapolatedMinimum result;
  const Vector6 twist = twice.col(0), change = twist - again.col(0);
  result.X_BT = {expSo3(angular(twist)) * finest.X_BT.R, finest.X_BT.p + linear(twist)};
  result.compliance = twice.rightCols<6>();
  result.pose_error = std::max(linear(change).norm() / length, angular(change).norm());
  result.compliance_error = complianceError(again.rightCols<6>(), result.compliance, length);
  result.finest = levels.back();
  return result;
}

}  // namespace live_stiffness
