#include "benchmark/methods/energy_minimum.h"

namespace live_stiffness {
namespace {

constexpr int kMostSteps = 100;
constexpr double kLongestTurn = 0.7;  // of a section in one step, rad
constexpr double kConverged = 1e-5;   // rad; Newton's method leaves the square of that
constexpr double kTooSmall = 1e-3;    // rad; rounding hides what the energy changes

// Positive, by a multiple of the material's stiffness if need be.
BlockCholesky factorised(const EnergyDerivatives& at, bool& shifted) {
  BlockCholesky factor(at.second);
  shifted = !factor.isPositive();
  for (double shift = 0.05; !factor.isPositive() && shift < 1e6; shift *= 4.0)
    factor = BlockCholesky(at.second.plus(shift, at.material));
  return factor;
}

}  // namespace

EnergyMinimum::EnergyMinimum(const Scene& scene, int intervals)
    : StiffnessMethod("energy minimiser, " + std::to_string(intervals) + " intervals a segment"), scene_(scene),
      chain_(scene), intervals_(intervals) {}

StiffnessSolution EnergyMinimum::solve(PressuresRef pressures) {
  StiffnessSolution solution;
  solution.status = statusOf(false);
  if (!chain_.setPressures(pressures)) return solution;
  std::vector<RestState> rest;
  for (const auto& piece : chain_.pieces())
    if (const auto* soft = std::get_if<SoftPiece>(&piece)) rest.push_back(soft->rest);
  const ChainEnergy energy(scene_, rest, Vector3::Zero(), intervals_);
  NodeRotations nodes = nodes_.empty() ? energy.unloaded() : nodes_;
  nodes_.clear();
  for (int i = 0; i < kMostSteps; ++i) {
    const EnergyDerivatives at = energy.derivatives(nodes);
    bool shifted = false;
    const BlockCholesky factor = factorised(at, shifted);
    const NodeVectors step = scaled(-1.0, factor.solve(at.gradient));
    const double length = largestNorm(step), slope = dot(step, at.gradient);
    if (!(length < 1e6)) return solution;
    double share = std::min(1.0, kLongestTurn / length);
    NodeRotations moved = turned(nodes, share, step);
    if (length > kTooSmall)
      for (const double now = energy.value(nodes);
           share * length > kTooSmall && energy.value(moved) > now + 1e-4 * share * slope;)
        moved = turned(nodes, share *= 0.5, step);
    nodes.swap(moved);
    if (shifted || length > kConverged) continue;
    const ChainPlacement placement = energy.place(nodes);
    const NodeBlocks<6>& by_wrench = placement.by_wrench;
    const NodeBlocks<6> turns = factor.solve(by_wrench);
    solution.compliance.setZero();
    solution.compliance.topLeftCorner<3, 3>() = placement.give;
    for (size_t k = 1; k < turns.size(); ++k) solution.compliance += by_wrench[k].transpose() * turns[k];
    solution.X_BT = placement.X_BT;
    solution.status = statusOf(solution.compliance.allFinite());
    nodes_ = nodes;
    break;
  }
  return solution;
}

}  // namespace live_stiffness
