// StaticsSolver: load continuation, which finds the stable equilibrium of a robot whose loads grow from zero.

#include <algorithm>
#include <cmath>

#include "rod/stability.h"
#include "rod/statics.h"

namespace live_stiffness {
namespace {

// A coarse search (equal steps, rough on the way) is used up to the normalised load kLargestCoarse, with steps of kStep.
constexpr double kLargestCoarse = 2.5, kStep = 0.3;
constexpr double kRough = 1e-2;            // accuracy of shape and sensitivities on its way
constexpr double kFarFromBuckling = 4.0;   // buckling factor up to which kRough is enough, since errors grow by it
// Quasi-Newton iterations are reliable for rods that the loads bend little. Under more load the base moment is needed to more
// digits than they give, so they get fewer iterations before Newton's method (hard_cases_test).
constexpr double kLittle = 1.2;            // normalised load
constexpr double kAwayFromBuckling = 8.0;  // buckling factor
constexpr double kRoughElements = 1e-3;    // accuracy of the elements on the way, in both searches

}  // namespace

// Finds the equilibrium for one load of a branch search, with more elements where the robot now bends more.
class StaticsSolver::Finder : public EquilibriumFinder {
 public:
  // kCoarse: on the way only what isTipTurningStable() needs is computed, roughly; the first load must allow only one
  // equilibrium.
  enum class Continuation { kCoarse, kAdaptive };

  Finder(StaticsSolver& solver, const DeadLoads& last, Backbone& backbone, StaticsReport& report, Continuation continuation)
      : solver_(solver), accuracy_(solver.accuracy_), last_(last), backbone_(backbone), report_(report),
        is_coarse_(continuation == Continuation::kCoarse), is_first_(is_coarse_) {}
  ~Finder() override { solver_.accuracy_ = accuracy_; }

  std::optional<Equilibrium> solve(const DeadLoads& loads, const Vector3& base_moment) override {
    prepare(solver_.chain_, loads, backbone_);
    const bool is_last = loads.gravity == last_.gravity && loads.tip == last_.tip;
    const bool is_rough = is_coarse_ && !is_last && solver_.buckling_factor_ < kFarFromBuckling;
    solver_.accuracy_ = is_rough ? std::max(accuracy_, kRough) : accuracy_;
    const SensitivitySet set = is_coarse_ && !is_last ? SensitivitySet::kBaseMoment : SensitivitySet::kAll;
    Vector3 guess = base_moment;
    bool refined = false;
    do {
      if (!(solveFirst(loads) || solveByChord(loads, guess, refined) || solveByNewton(loads, guess)) ||
          !solver_.findTangent(loads, backbone_, report_, set)) {
        solver_.forgetGuesses(loads, backbone_);
        return std::nullopt;
      }
      guess = solver_.base_moment_;
    } while ((refined = refine(loads, is_last ? accuracy_ : kRoughElements)));
    return Equilibrium{solver_.base_moment_, backbone_.X_BT.p, solver_.tangent_,
                       solver_.isStable(loads, backbone_, report_, set)};
  }
  double bendingOf(const Vector3& moment) const override { return solver_.bendingOf(moment); }
  bool exhausted() const override { return report_.iterations >= kMaxIterations; }

 private:
  // From the unloaded shape.
  bool solveFirst(const DeadLoads& loads) {
    if (!is_first_) return false;
    is_first_ = false;
    solver_.base_moment_ = solver_.momentOfUnloaded(loads, backbone_);
    return solver_.chordIteration(loads, Known::kNone, kMaxSweeps, backbone_, report_);
  }
  // From shape and sensitivities at the loads before, or from the base moment found with fewer elements.
  bool solveByChord(const DeadLoads& loads, const Vector3& base_moment, bool refined) {
    const int few_sweeps = is_coarse_ || normalisedLoad(solver_.chain_, loads, backbone_) < kLittle ? 30 : 12;
    const bool has_sensitivities = solver_.nodes_hold_guess_ && solver_.has_sensitivities_;
    if (!(has_sensitivities || refined) || solver_.buckling_factor_ > kAwayFromBuckling) return false;
    if (has_sensitivities) {
      const Vector3 step = base_moment - solver_.base_moment_;
      const ChainState chain = stateOf(solver_.chain_, loads, base_moment, backbone_);
      backbone_.kernel->follow_all(chain, {step.x(), step.y(), step.z()});
    }
    solver_.base_moment_ = base_moment;
    const int before = report_.iterations;
    const Known known = has_sensitivities ? Known::kSensitivities : Known::kInverse;
    const bool converged = solver_.chordIteration(loads, known, few_sweeps, backbone_, report_);
    report_.iterations = before + 1;  // as much work as one converged shot
    return converged;
  }
  bool solveByNewton(const DeadLoads& loads, const Vector3& base_moment) {
    solver_.base_moment_ = base_moment;
    solver_.warm_ = false;
    return solver_.newton(loads, backbone_, 12, report_);
  }
  bool refine(const DeadLoads& loads, double tolerated) {
    if (!solver_.discretisation_.refine(report_.buckling_factor, backbone_, tolerated)) return false;
    solver_.forgetGuesses(loads, backbone_);
    return true;
  }

  StaticsSolver& solver_;
  const double accuracy_;
  const DeadLoads& last_;
  Backbone& backbone_;
  StaticsReport& report_;
  const bool is_coarse_;
  bool is_first_;
};

// Refines a solution to the full accuracy; restores it if that fails or leads to an equilibrium that is not stable.
void StaticsSolver::refineSolution(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  const Vector3 before = base_moment_;
  StaticsReport finer;
  if (chordIteration(loads, Known::kSensitivities, kMaxSweeps, backbone, finer) && findTangent(loads, backbone, finer) &&
      isStable(loads, backbone, finer)) {
    report.residual = finer.residual;
    report.iteration = finer.iteration;
  } else {
    Vector3 residual;
    base_moment_ = before;
    forgetGuesses(loads, backbone);
    report.stable = integrateChain(loads, before, backbone, residual) && findTangent(loads, backbone, report);
  }
  report.iterations += finer.iterations;
}

bool StaticsSolver::findAlongLoads(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  discretisation_.choose(loads, backbone);
  placeFresh(DeadLoads(), backbone);
  const double normalised_load = normalisedLoad(chain_, loads, backbone);
  BranchEnd end = BranchEnd::kNotConverged;
  if (normalised_load < kLargestCoarse) {
    Finder finder(*this, loads, backbone, report, Finder::Continuation::kCoarse);
    BranchSearch search(finder, length_);
    const Equilibrium unloaded{Vector3::Zero(), backbone.X_BT.p, {}, true};
    const int steps = std::max(1, static_cast<int>(std::ceil(normalised_load / kStep)));
    if (search.runCoarse(loads, unloaded, steps)) end = BranchEnd::kLoading;
  }
  if (end != BranchEnd::kLoading) {
    discretisation_.shorten();
    discretisation_.choose(loads, backbone);
    placeFresh(DeadLoads(), backbone);
    Finder finder(*this, loads, backbone, report, Finder::Continuation::kAdaptive);
    BranchSearch search(finder, length_);
    end = search.run(loads);
    report.stable_share = search.stableShare();
  }
  report.buckled = end == BranchEnd::kBuckled;
  report.stable = report.buckled || end == BranchEnd::kLoading;
  if (report.stable && (report.residual + report.iteration) * report.buckling_factor > accuracy_)
    refineSolution(loads, backbone, report);
  return end != BranchEnd::kNotConverged;
}

}  // namespace live_stiffness
