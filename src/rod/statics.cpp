#include "rod/statics.h"

#include <algorithm>

#include "rod/stability.h"

namespace live_stiffness {
namespace {

constexpr double kNodes = 0.6, kFineNodes = 0.05;  // rad, between nodes of a descent; the second where the first does not do
constexpr double kLargestDirect = 2.5;  // normalised load up to which a cold start needs no descent

}  // namespace

StaticsSolver::StaticsSolver(const Scene& scene, double accuracy, int stages)
    : chain_(scene),
      accuracy_(accuracy),
      discretisation_(chain_, accuracy, stages),
      shape_(chain_),
      descent_(chain_),
      rate_(kSlowestRate) {}

void StaticsSolver::reset() {
  warm_ = has_sensitivities_ = false;
  solutions_ = 0;
  buckling_factor_ = 1.0;
  rate_ = kSlowestRate;
  discretisation_.reset();
}

void StaticsSolver::prepareUnloaded(Backbone& backbone) {
  reset();
  if (discretisation_.chooseUnloaded(backbone)) discretisation_.apply(backbone);
  prepare(chain_, DeadLoads(), backbone);
}

// Moments with which the shape of the elements carries the loads.
void StaticsSolver::balance(const DeadLoads& loads, Backbone& backbone) {
  const MarchResult without = march(chain_, loads, Vector3::Zero(), MarchMode::kShape, backbone);
  for (RodElement& element : backbone.elements)
    for (int i = 0; i < 3; ++i) element.state.m_start[i] -= without.residual[i];
}

// The same shape on the elements that are chosen now.
void StaticsSolver::rebuild(const DeadLoads& loads, Backbone& backbone) {
  constexpr int kEach = 6;
  shape_.resize(backbone, kEach);
  shape_.take(backbone);
  discretisation_.apply(backbone);
  prepare(chain_, loads, backbone);
  shape_.place(backbone);
  balance(loads, backbone);
  has_sensitivities_ = false;
  solutions_ = 0;
}

// Extrapolates a guess from the last solutions. Sensitivities are not extrapolated where one iteration of them is enough
// anyway.
void StaticsSolver::extrapolateGuess(const DeadLoads& loads, Backbone& backbone) {
  constexpr double kOneIteration = 1e-4;
  const History known = accuracy_ < kOneIteration && has_sensitivities_ ? History::kSensitivities : History::kShape;
  const bool has_history = solutions_ >= 2 && known == history_;
  prepare(chain_, loads, backbone, known, has_history);
  history_ = known;
}

bool StaticsSolver::guess(Start start, const DeadLoads& loads, Backbone& backbone) {
  if (start == Start::kWarm) {
    extrapolateGuess(loads, backbone);
    return true;
  }
  has_sensitivities_ = false;
  solutions_ = 0;
  if (start == Start::kUnloaded) {
    prepare(chain_, loads, backbone);
    march(chain_, loads, Vector3::Zero(), MarchMode::kUnloaded, backbone);
    balance(loads, backbone);
    IterationResult once;
    backbone.kernel->iterate_all(stateOf(chain_, loads, Vector3::Zero(), backbone), once);
    balance(loads, backbone);
    return once.is_admissible;
  }
  prepare(chain_, loads, backbone);
  // The same nodes for every accuracy, so that all end in the same valley.
  shape_.resize(discretisation_.demand(), start == Start::kFineDescent ? kFineNodes : kNodes);
  shape_.takeUnloaded(chain_, backbone);
  const EnergyDescent::End end = descent_.run(loads, backbone.rest, 1.0 / normalised_load_, shape_);
  neutral_ = end == EnergyDescent::End::kNeutral;
  if (discretisation_.chooseFor(shape_, backbone)) {
    discretisation_.apply(backbone);
    prepare(chain_, loads, backbone);
  }
  shape_.place(backbone);
  balance(loads, backbone);
  return end == EnergyDescent::End::kMinimum;
}

bool StaticsSolver::solveFrom(Start start, const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  constexpr int kMostWarm = 15, kMostCold = 60, kMostRefinements = 6;
  if (!guess(start, loads, backbone)) return false;
  for (int refinement = 0; refinement < kMostRefinements; ++refinement) {
    const int most = start == Start::kWarm && refinement == 0 ? kMostWarm : kMostCold;
    if (!converge(start, loads, most, backbone, report) || !findTangent(loads, backbone, report)) return false;
    report.converged = true;
    if (discretisation_.refine(report.buckling_factor, backbone)) rebuild(loads, backbone);
    else if (!((report.residual + report.iteration) * report.buckling_factor > accuracy_)) return report.stable;
  }
  return report.stable;
}

bool StaticsSolver::solveCold(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  reset();
  normalised_load_ = normalisedLoad(chain_, loads, backbone);
  neutral_ = false;
  // Forces alone always leave a minimum of the energy; so without a moment nothing stable is missing but where it is neutral.
  const bool has_moment = !angular(loads.tip).isZero(0.0);
  bool none_is_stable = false;
  for (const Start start : {Start::kUnloaded, Start::kDescent, Start::kFineDescent}) {
    if (neutral_ || (start == Start::kUnloaded && !(normalised_load_ < kLargestDirect))) continue;
    if (start == Start::kFineDescent) discretisation_.shorten();
    if (discretisation_.choose(loads, backbone)) discretisation_.apply(backbone);
    const int before = report.iterations;
    report = StaticsReport();
    report.iterations = before;
    if (solveFrom(start, loads, backbone, report)) return true;
    none_is_stable = none_is_stable || neutral_ || (report.converged && (report.neutral || has_moment));
  }
  report.converged = none_is_stable;
  report.stable = false;
  return false;
}

// The largest share of the loads under which there is a stable equilibrium that is not neutral, to 0.1 %, if these are the
// small ones.
double StaticsSolver::stableShare(const DeadLoads& loads, Backbone& backbone) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 10; ++i) {
    const double share = 0.5 * (low + high);
    StaticsReport report;
    (solveCold(loads.scaled(share), backbone, report) ? low : high) = share;
  }
  return low;
}

StaticsReport StaticsSolver::solve(const DeadLoads& loads, Backbone& backbone) {
  bending_compliance_ = stiffest_ = most_compliant_ = 0.0;
  for (const Chain::Part& part : chain_.parts)
    if (part.segment >= 0) {
      const RestState& rest = backbone.rest[part.segment];
      const double length = rest.stretch * part.length;
      const double compliance = rest.c.bending_torsion.diagonal().maxCoeff() * length;
      bending_compliance_ = std::max(bending_compliance_, compliance);
      most_compliant_ += compliance;
      stiffest_ += rest.c.bending_torsion.diagonal().minCoeff() * length;
    }
  StaticsReport report;
  bool solved = false;
  if (warm_) {
    if (discretisation_.choose(loads, backbone)) rebuild(loads, backbone);
    solved = solveFrom(Start::kWarm, loads, backbone, report);
  }
  if (!solved && !solveCold(loads, backbone, report) && report.converged) {
    report.stable_share = stableShare(loads, backbone);
    warm_ = false;
    return report;
  }
  warm_ = report.stable;
  solutions_ = warm_ ? solutions_ + 1 : 0;
  return report;
}

}  // namespace live_stiffness
