#include "live_stiffness/compliance/stiffness_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "live_stiffness/checks.h"
#include "compliance/material_compliance.h"
#include "compliance/station_reader.h"
#include "compliance/stiffness_workspace.h"

namespace live_stiffness {

const char* codeName(SolveCode code) {
  switch (code) {
    case SolveCode::kOk: return "ok";
    case SolveCode::kInvalidInput: return "invalid_input";
    case SolveCode::kOutOfRange: return "out_of_range";
    case SolveCode::kNotConverged: return "not_converged";
    case SolveCode::kUnstable: return "unstable";
  }
  return "unknown";
}

StiffnessWorkspace::StiffnessWorkspace(std::unique_ptr<State> state) : state_(std::move(state)) {}
StiffnessWorkspace::StiffnessWorkspace(StiffnessWorkspace&&) noexcept = default;
StiffnessWorkspace& StiffnessWorkspace::operator=(StiffnessWorkspace&&) noexcept = default;
StiffnessWorkspace::~StiffnessWorkspace() = default;

const Backbone& StiffnessWorkspace::backbone() const { return state_->backbone; }
const StaticsSolver& StiffnessWorkspace::statics() const { return state_->statics; }
bool StiffnessWorkspace::loaded() const { return state_->loaded; }
void StiffnessWorkspace::reset() { state_->statics.reset(); }

StiffnessModel::StiffnessModel(Scene scene, ModelOptions options)
    : scene_(std::move(scene)),
      options_(options),
      chamber_count_(scene_.chamberCount()), has_weight_(scene_.hasWeight()) {
  FaultList faults("stiffness model");
  if (scene_.segmentCount() == 0) faults.add("chain: must hold at least one segment");
  faults.checkAll(options_);
  faults.throwIfAny();
  walk(
      scene_, [&](int, const Segment& segment) { steppers_.emplace_back(segment.section); }, [](const Link&) {});
}

StiffnessModel::~StiffnessModel() = default;

StiffnessWorkspace StiffnessModel::makeWorkspace() const {
  return StiffnessWorkspace(std::make_unique<StiffnessWorkspace::State>(scene_, options_.accuracy));
}

SolveStatus StiffnessModel::checkInput(PressuresRef pressures, const Wrench& tip_wrench) const {
  if (pressures.size() != chamber_count_) return {SolveCode::kInvalidInput, -1, static_cast<double>(pressures.size())};
  constexpr double kLargest = std::numeric_limits<double>::max();
  bool all_fit = true;
  const auto fits = [](double p) { return (p >= -kAtmospherePa) & (p <= kLargest); };
  for (int k = 0; k < pressures.size(); ++k) all_fit &= fits(pressures[k]);
  for (int k = 0; !all_fit; ++k)
    if (!fits(pressures[k])) return {SolveCode::kInvalidInput, k, pressures[k]};
  if (!tip_wrench.allFinite()) return {SolveCode::kInvalidInput, chamber_count_, std::nan("")};
  return {};
}

SolveStatus StiffnessModel::stepLoads(PressuresRef pressures, Backbone& backbone) const {
  int steps = 1;
  if (options_.stepping == Stepping::kFixedStep) {
    const double largest = pressures.size() > 0 ? pressures.cwiseAbs().maxCoeff() : 0.0;
    if (largest > 1e4 * options_.pressure_step) return {SolveCode::kOutOfRange, -1, largest};
    steps = stepCount(largest, options_.pressure_step);
  }
  SolveStatus status;
  Eigen::Index first = 0;
  for (size_t k = 0; k < steppers_.size(); ++k) {
    RestState& rest = backbone.rest[k];
    const Eigen::Index count = steppers_[k].chamberCount();
    rest = steppers_[k].restState(pressures.segment(first, count), options_.stepping, steps);
    if (!rest.valid && status.ok()) status = {SolveCode::kOutOfRange, static_cast<int>(k), rest.stretch};
    first += count;
  }
  return status;
}

StiffnessSolution StiffnessModel::solve(PressuresRef pressures, const Wrench& tip_wrench,
                                        StiffnessWorkspace& workspace) const {
  StiffnessSolution solution{StiffnessSolution::Unset()};
  solution.status = solveInto(solution, pressures, tip_wrench, workspace);
  if (!solution.status.ok()) solution.clearCompliances();
  return solution;
}

SolveStatus StiffnessModel::solveInto(StiffnessSolution& solution, PressuresRef pressures, const Wrench& tip_wrench,
                                      StiffnessWorkspace& workspace) const {
  StiffnessWorkspace::State& state = *workspace.state_;
  Backbone& backbone = state.backbone;
  SolveStatus status = checkInput(pressures, tip_wrench);
  if (status.ok()) status = stepLoads(pressures, backbone);
  if (!status.ok()) return status;

  state.loaded = options_.external_loads && (has_weight_ || !tip_wrench.isZero(0.0));
  if (state.loaded) {
    const DeadLoads loads{scene_.gravity.value_or(Vector3::Zero()), tip_wrench};
    const StaticsReport report = state.statics.solve(loads, backbone);
    solution.iterations = report.iterations;
    if (!report.converged) return {SolveCode::kNotConverged, -1, report.residual};
    if (!report.stable) return {SolveCode::kUnstable, -1, report.stable_share};
    solution.numerical_error = report.relativeError() * report.buckling_factor;
    const Chain& chain = state.statics.chain();
    accumulateMaterial(chain, options_.accuracy, backbone, solution.material_compliance);
    solution.compliance = state.statics.tangentCompliance();
  } else {
    state.statics.prepareUnloaded(backbone);
    const Chain& chain = state.statics.chain();
    solution.numerical_error = solveUnloaded(chain, options_.accuracy, backbone, solution.material_compliance);
    solution.compliance = solution.material_compliance;  // without external load the two are the same matrix
  }
  solution.X_BT = backbone.X_BT;
  solution.numerical_error += 1e-14;  // rounding
  // A sum is finite only if all its terms are.
  double sum = solution.X_BT.p.sum() + solution.material_compliance.sum();
  if (state.loaded) sum += solution.compliance.sum();
  if (!std::isfinite(sum)) return {SolveCode::kNotConverged, -1, 0.0};
  return {};
}

Station StiffnessModel::station(const StiffnessWorkspace& workspace, int segment, double fraction) const {
  return stationAt(workspace.backbone(), segment, fraction, {options_.accuracy, workspace.loaded()});
}

void StiffnessModel::stations(const StiffnessWorkspace& workspace, int segment, StationPlan& plan, Station* out) const {
  plan.batches_->read(workspace.backbone(), segment, {options_.accuracy, workspace.loaded()}, out);
}

std::string StiffnessModel::describe(const SolveStatus& status) const {
  const std::string value = numberText(status.value);
  switch (status.code) {
    case SolveCode::kOk:
      return "ok";
    case SolveCode::kInvalidInput:
      if (status.index < 0)
        return value + " pressures given, but the scene has " + std::to_string(scene_.chamberCount()) +
               " chambers: give one gauge pressure per chamber, base to tip";
      if (status.index >= scene_.chamberCount()) return "the tip wrench must be finite";
      return "pressure of chamber " + std::to_string(status.index + 1) + " is " + value +
             " Pa: must be finite and at least -101325 Pa gauge (vacuum); is it absolute, or in another unit?";
    case SolveCode::kOutOfRange:
      if (status.index < 0) return "largest pressure is " + value + " Pa: more than 10000 pressure steps";
      return "segment " + std::to_string(status.index + 1) + " reaches stretch " + value +
             ", where its section has no positive area left: lower its pressures";
    case SolveCode::kNotConverged:
      return "no equilibrium found within the bound on iterations: lower the loads or pressures, or check the scene";
    case SolveCode::kUnstable:
      return "no stable equilibrium: beyond " + value + " of its loads the robot may lean in any direction or has nowhere to "
             "rest; lower its loads or pressures";
  }
  return "unknown status";
}

}  // namespace live_stiffness
