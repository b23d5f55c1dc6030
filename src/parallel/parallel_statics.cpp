#include "parallel/parallel_statics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "parallel/platform_guess.h"

namespace live_stiffness {
namespace {

// An error of one rod loads the others, so errors are larger than in a single rod: up to six times, measured over the
// configurations of test/parallel.
constexpr double kMisfit = 8.0;
constexpr double kOnTheWay = 1e-3, kFinest = 1e-13;  // goals of Newton's method, rad
constexpr int kPathSlot = 0, kStepSlot = 1;  // snapshots of the coupling

}  // namespace

ParallelStatics::ParallelStatics(const ParallelScene& scene, double accuracy, Simd simd)
    : scene_(scene), accuracy_(accuracy), coupling_(scene, accuracy, simd), start_lengths_(scene.rods.size(), 0.0) {}

// From the last solution, moved to first order by the change of lengths and wrench.
void ParallelStatics::setInputs(const Goal& goal, const Wrench& last_wrench) {
  constexpr double kLargestStep = 0.5;
  coupling_.wrench = goal.wrench;
  if (goal.unknown == Unknown::kLengths) {
    coupling_.X_BP = goal.X_BP;
    return;
  }
  for (size_t i = 0; i < start_lengths_.size(); ++i)
    start_lengths_[i] = (*goal.lengths)[i] - coupling_.rods()[i].length();
  const double size = coupling_.findPrediction(start_lengths_, goal.wrench - last_wrench);
  for (size_t i = 0; i < start_lengths_.size(); ++i) coupling_.rods()[i].setLength((*goal.lengths)[i]);
  if (size < kLargestStep) coupling_.makeStep(Unknown::kPose, 1.0);
}

bool ParallelStatics::linearise(Unknown unknown, ParallelReport& report) {
  report.iteration = coupling_.linearise(0.2 * accuracy_);
  if (!std::isfinite(report.iteration)) return false;
  if (unknown == Unknown::kLengths) coupling_.assembleLengths();
  return true;
}

// Quasi-Newton: one iteration of every element, then a step with the matrices of the last linearisation, and so on.
bool ParallelStatics::chordIteration(Unknown unknown, ParallelReport& report) {
  constexpr int kMaxSweeps = 25;
  constexpr double kRounding = 1e-9, kLargestStep = 1.0;
  const double goal = std::max(0.5 * accuracy_, 1e-15);
  double last = kInfinity;
  int growing = 0;
  for (int i = 0; i < kMaxSweeps; ++i) {
    ++report.iterations;
    const double change = coupling_.sweepAll();
    report.step = std::isfinite(change) ? coupling_.findStep(unknown) : kInfinity;
    const double error = std::max(change, report.step);
    if (!(error < kLargestStep) || (growing += error > last) > 2) return false;
    const bool at_rounding = error <= kRounding && error >= 0.5 * last;
    coupling_.makeStep(unknown, 1.0);  // the last one to first order, for pose and loads
    if (error <= goal || at_rounding) return true;
    last = error;
  }
  return false;
}

// Damped Newton steps with converged shapes. A step is accepted if the next one, with the same matrices, is smaller; in this
// test stiff directions do not dominate.
bool ParallelStatics::newton(Unknown unknown, double goal, ParallelReport& report) {
  constexpr int kMaxSteps = 30;
  constexpr double kStalled = 1e-8, kLargestStep = 3.0, kLeastShare = 1e-3;
  if (!coupling_.integrateAll()) return false;
  for (int i = 0; i < kMaxSteps && report.iterations < kMaxIterations; ++i) {
    if (coupling_.changesAny(&ClampedRod::refineForLoad) && !coupling_.integrateAll()) return false;
    if (!linearise(unknown, report)) return false;
    report.step = coupling_.findStep(unknown);
    if (report.step <= goal) return true;
    if (!std::isfinite(report.step)) return false;
    coupling_.save(kStepSlot);
    for (double share = std::min(1.0, kLargestStep / report.step);; share *= 0.5) {
      if (share < kLeastShare) return false;
      ++report.iterations;
      coupling_.makeStep(unknown, share);
      const double next = coupling_.integrateAll() ? coupling_.findStep(unknown) : kInfinity;
      if (next <= (1.0 - 0.25 * share) * report.step) break;
      if (report.step < kStalled) {  // limited by rounding
        report.step = std::min(next, report.step);
        return linearise(unknown, report);
      }
      coupling_.restore(kStepSlot);
      if (!coupling_.integrateAll()) return false;
      report.step = coupling_.findStep(unknown);
    }
  }
  return false;
}

// Newton's method along set(share), from share 0, where the coupling is in equilibrium, to 1: in one step, else in several.
template <class Set>
bool ParallelStatics::follow(Set set, Unknown unknown, ParallelReport& report) {
  constexpr double kLeastStep = 1.0 / 128.0;
  double done = 0.0, step = 1.0;
  while (done < 1.0 && report.iterations < kMaxIterations) {
    coupling_.save(kPathSlot);
    const double next = std::min(1.0, done + step);
    set(next);
    if (newton(unknown, next < 1.0 ? kOnTheWay : kFinest, report)) {
      done = next;
      step *= 2.0;
      continue;
    }
    coupling_.restore(kPathSlot);
    set(done);
    step *= 0.5;
    if (step < kLeastStep || !coupling_.integrateAll()) return false;
  }
  return done >= 1.0;
}

// From the present equilibrium to that of the inputs.
bool ParallelStatics::followInputs(const Goal& goal, ParallelReport& report) {
  const Wrench from = coupling_.wrench;
  const Pose start = coupling_.X_BP;
  const Vector3 turn = logSo3(goal.X_BP.R * start.R.transpose());
  for (size_t i = 0; i < start_lengths_.size(); ++i) start_lengths_[i] = coupling_.rods()[i].length();
  return follow(
      [&](double share) {
        coupling_.wrench = from + share * (goal.wrench - from);
        if (goal.unknown == Unknown::kLengths)
          coupling_.X_BP = {expSo3(share * turn) * start.R, start.p + share * (goal.X_BP.p - start.p)};
        else
          for (size_t i = 0; i < start_lengths_.size(); ++i)
            coupling_.rods()[i].setLength(start_lengths_[i] + share * ((*goal.lengths)[i] - start_lengths_[i]));
      },
      goal.unknown, report);
}

bool ParallelStatics::startCold(const Goal& goal, ParallelReport& report) {
  const bool for_lengths = goal.unknown == Unknown::kLengths;
  coupling_.X_BP = for_lengths ? goal.X_BP : guessPlatformPose(scene_, *goal.lengths);
  for (size_t i = 0; i < start_lengths_.size(); ++i)
    start_lengths_[i] = lengthOfCurve(scene_.rods[i], coupling_.X_BP);
  coupling_.placeStraight(start_lengths_);
  const bool homotopy = follow([&](double share) { coupling_.homotopy = share; }, Unknown::kFreeLengths, report);
  coupling_.homotopy = 1.0;
  if (!homotopy || (coupling_.changesAny(&ClampedRod::choose) && !coupling_.integrateAll())) return false;
  coupling_.wrench = coupling_.wrenchOfRods();
  return followInputs(goal, report);
}

// Tangent, and more elements where the error estimate is too large.
bool ParallelStatics::finish(Unknown unknown, ParallelReport& report) {
  constexpr int kMaxRefinements = 6;
  if (!linearise(unknown, report)) return false;
  for (int i = 0;; ++i) {
    report.truncation = kMisfit * coupling_.largestTruncation();
    bool refined = coupling_.changesAny(&ClampedRod::refineForLoad);
    if (i < kMaxRefinements)
      for (ClampedRod& rod : coupling_.rods()) refined = rod.refine(kMisfit) || refined;
    if (!refined) return coupling_.platformCompliance().allFinite();
    if (!newton(unknown, kFinest, report)) return false;
  }
}

bool ParallelStatics::isStable() const {
  const Matrix6& K = coupling_.platformStiffness();
  return (0.5 * (K + K.transpose())).llt().info() == Eigen::Success && coupling_.rodsAreStable();
}

ParallelReport ParallelStatics::solve(const Goal& goal) {
  ParallelReport report;
  if (warm_) {
    if (goal.unknown == Unknown::kLengths) coupling_.assembleLengths();
    const Wrench last_wrench = coupling_.wrench;
    coupling_.save(kPathSlot);
    setInputs(goal, last_wrench);
    report.converged = chordIteration(goal.unknown, report) && finish(goal.unknown, report);
    if (!report.converged) {
      coupling_.restore(kPathSlot);
      coupling_.wrench = last_wrench;
      report.converged = coupling_.integrateAll() && followInputs(goal, report) && finish(goal.unknown, report);
    }
    report.stable = report.converged && isStable();
  }
  if (!report.stable) {
    ParallelReport cold;
    cold.converged = startCold(goal, cold) && finish(goal.unknown, cold);
    cold.stable = cold.converged && isStable();
    cold.iterations += report.iterations;
    report = cold;
  }
  coupling_.X_BP.R = orthonormalised(coupling_.X_BP.R);
  warm_ = report.converged && report.stable;
  return report;
}

ParallelReport ParallelStatics::solveForPose(const std::vector<double>& lengths, const Wrench& wrench) {
  return solve({Unknown::kPose, coupling_.X_BP, &lengths, wrench});
}

ParallelReport ParallelStatics::solveForLengths(const Pose& X_BP, const Wrench& wrench) {
  return solve({Unknown::kLengths, X_BP, nullptr, wrench});
}

}  // namespace live_stiffness
