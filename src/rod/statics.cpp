#include "rod/statics.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "rod/conjugate_points.h"
#include "rod/stability.h"

namespace live_stiffness {

StaticsSolver::StaticsSolver(const Scene& scene, double accuracy, int stages)
    : chain_(scene),
      length_(scene.length()),
      accuracy_(accuracy),
      discretisation_(chain_, accuracy, stages),
      rate_(kSlowestRate) {}

void StaticsSolver::reset() {
  warm_ = has_sensitivities_ = false;
  solutions_ = 0;
  buckling_factor_ = 1.0;
  rate_ = kSlowestRate;
  discretisation_.reset();
}

void StaticsSolver::forgetGuesses(const DeadLoads& loads, Backbone& backbone) {
  prepare(chain_, loads, backbone);
  warm_ = has_sensitivities_ = nodes_hold_guess_ = false;
  solutions_ = 0;
}

// Puts the backbone into the unloaded shape; sets the base moment that the loads exert on that shape.
void StaticsSolver::placeFresh(const DeadLoads& loads, Backbone& backbone) {
  placeUnloaded(chain_, backbone);
  forgetGuesses(loads, backbone);
  nodes_hold_guess_ = true;
  base_moment_ = momentOfUnloaded(loads, backbone);
}

// Base moment that the loads exert on the unloaded shape, which the backbone must have.
Vector3 StaticsSolver::momentOfUnloaded(const DeadLoads& loads, const Backbone& backbone) const {
  Vector3 moment = angular(loads.tip) + backbone.X_BT.p.cross(linear(loads.tip) + chain_.tip_mass * loads.gravity);
  const GaussLegendre& table = gaussLegendre(backbone.kernel->stages);
  auto element = backbone.elements.begin();
  Pose X;
  for (const Chain::Part& part : chain_.parts) {
    if (part.segment < 0) {
      moment += (X.p + 0.5 * part.length * X.R.col(2)).cross(part.mass * loads.gravity);
      X.p += part.length * X.R.col(2);
      continue;
    }
    const int count = backbone.element_count[part.segment];
    for (int k = 0; k < count; ++k, ++element) {
      Vector3 centre = element->p_start();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < table.nodes; ++j) centre[i] += table.b[j] * element->state.offset[i][j];
      moment += centre.cross(part.mass / count * loads.gravity);
      X = element->X_end();
    }
  }
  return moment;
}

void StaticsSolver::prepareUnloaded(Backbone& backbone) {
  warm_ = has_sensitivities_ = false;
  solutions_ = 0;
  buckling_factor_ = 1.0;
  rate_ = kSlowestRate;
  discretisation_.chooseUnloaded(backbone);
  prepare(chain_, DeadLoads(), backbone);
}

// Extrapolates a guess from the last solutions. Sensitivities are not extrapolated where one iteration of them is enough
// anyway.
void StaticsSolver::extrapolateGuess(const DeadLoads& loads, Backbone& backbone) {
  constexpr double kOnePass = 1e-4;
  const History known = accuracy_ < kOnePass && has_sensitivities_ ? History::kSensitivities : History::kShape;
  const bool has_history = solutions_ >= 2 && known == history_;
  const double extrapolation = prepare(chain_, loads, backbone, known, has_history);
  history_ = known;
  const Vector3 last = base_moment_;
  base_moment_ += extrapolation * (last - moment_before_);
  moment_before_ = last;
}

// By the fastest method that converges, on any branch.
bool StaticsSolver::findEquilibrium(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  Known known = !warm_ ? Known::kNone : has_sensitivities_ ? Known::kSensitivities : Known::kInverse;
  if (warm_) extrapolateGuess(loads, backbone);
  else placeFresh(loads, backbone);
  while (true) {
    bool converged = chordIteration(loads, known, kMaxSweeps, backbone, report);
    if (!converged) {
      discretisation_.shorten();
      const bool is_shorter = discretisation_.choose(loads, backbone);
      placeFresh(loads, backbone);
      converged = is_shorter && chordIteration(loads, Known::kNone, kMaxSweeps, backbone, report);
    }
    if (!converged) {
      placeFresh(loads, backbone);
      converged = newton(loads, backbone, 30, report);
    }
    if (!converged || !findTangent(loads, backbone, report)) return false;
    known = Known::kSensitivities;
    if (discretisation_.refine(report.buckling_factor, backbone)) {
      forgetGuesses(loads, backbone);
      known = Known::kInverse;
    } else if (!((report.residual + report.iteration) * report.buckling_factor > accuracy_) ||
               report.iterations >= kMaxIterations / 2) {
      return true;
    }
  }
}

bool StaticsSolver::isStable(const DeadLoads& loads, const Backbone& backbone, const StaticsReport& report,
                             SensitivitySet set) const {
  const double error = report.relativeError();
  return (set == SensitivitySet::kAll ? isTipStable(tangent_, bending_compliance_, error)
                                 : isTipTurningStable(tangent_.bottomRightCorner<3, 3>(), bending_compliance_, error)) &&
         !(mayBuckle(loads, backbone) && conjugatePoints(backbone) > 0);
}

bool StaticsSolver::mayBuckle(const DeadLoads& loads, const Backbone& backbone) const {
  return !(normalisedLoad(chain_, loads, backbone) < 1.0);  // NaN, too
}

StaticsReport StaticsSolver::solve(const DeadLoads& loads, Backbone& backbone) {
  StaticsReport report;
  bending_compliance_ = stiffest_ = 0.0;
  for (const Chain::Part& part : chain_.parts)
    if (part.segment >= 0) {
      const RestState& rest = backbone.rest[part.segment];
      const double length = rest.stretch * part.length;
      bending_compliance_ = std::max(bending_compliance_, rest.c.bending_torsion.diagonal().maxCoeff() * length);
      stiffest_ += rest.c.bending_torsion.diagonal().minCoeff() * length;
    }
  // New elements hold no guess, but the base moment is kept.
  if (discretisation_.choose(loads, backbone)) {
    has_sensitivities_ = nodes_hold_guess_ = false;
    solutions_ = 0;
  }
  // Newton's method may converge to any equilibrium. So where there may be several, it is used only near a stable one.
  if (warm_ || !mayBuckle(loads, backbone)) {
    report.converged = findEquilibrium(loads, backbone, report);
    report.stable = report.converged && isStable(loads, backbone, report);
  }
  if (!report.stable) {
    StaticsReport second;
    second.converged = findAlongLoads(loads, backbone, second);
    second.iterations += report.iterations;
    report = second;
  }
  warm_ = report.converged && report.stable;
  solutions_ = warm_ ? solutions_ + 1 : 0;
  return report;
}

}  // namespace live_stiffness
