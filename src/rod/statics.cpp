#include "live_stiffness/rod/statics.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "live_stiffness/rod/conjugate_points.h"
#include "live_stiffness/rod/kinematics.h"
#include "live_stiffness/rod/stability.h"

namespace live_stiffness {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kResidualGoal = 1e-12;     // rad, see StaticsReport::residual
constexpr double kResidualAccepted = 1e-8;  // rad, when rounding stops it short of the goal; it is part of the estimate
constexpr double kRoughColumns = 1e-2;      // relative error, enough for sweeps to converge
constexpr double kFineColumns = 1e-12;      // for Newton steps where the residual is nearly singular, or huge
constexpr double kMostAmplification = 1e6;
constexpr double kRoughShape = 1e-3;        // error of discretisation that does for loads on the way to the last
constexpr int kMaxSweeps = 40;
constexpr double kQuickestRate = 0.01;      // and no better than this
constexpr double kSlowestRate = 0.2;        // at which sweeps may be counted on to converge

}  // namespace

StaticsSolver::StaticsSolver(const Scene& scene, double accuracy, int stages)
    : chain_(scene),
      length_(scene.length()),
      accuracy_(accuracy),
      discretisation_(chain_, accuracy, stages),
      rate_(kSlowestRate) {}

void StaticsSolver::reset() {
  warm_ = has_columns_ = false;
  solutions_ = 0;
  amplification_ = 1.0;
  rate_ = kSlowestRate;
  discretisation_.reset();
}

bool StaticsSolver::march(const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone, Vector3& residual) {
  nodes_hold_guess_ = shoot(chain_, loads, base_moment, nodes_hold_guess_, backbone, residual);
  return nodes_hold_guess_;
}

bool StaticsSolver::updateInverse(const DeadLoads& loads, double goal, Backbone& backbone) {
  ElementColumns columns;
  const double change = tipColumns(chain_, loads, !has_columns_, goal, backbone, columns);
  has_columns_ = std::isfinite(change);
  residual_inverse_ = columnsOf(columns.m).leftCols<3>().inverse();
  return has_columns_ && residual_inverse_.allFinite();
}

// Sweeps of one pass an element, each followed by a step of the base moment with the kept inverse: shape and moment
// converge together, linearly, by a factor of about ten a sweep. Without trouble it takes one to ten.
bool StaticsSolver::quick(const DeadLoads& loads, Known known, int max_sweeps, Backbone& backbone,
                          StaticsReport& report) {
  const int sweeps_before_columns = known == Known::kNothing ? 2 : 0;
  bool has_columns = known == Known::kColumns;
  constexpr double kRounding = 1e-13;
  const double goal = std::max(0.2 * accuracy_ / amplification_, 1e-15);
  if (known == Known::kNothing) residual_inverse_.setIdentity();  // right but for the load's own effect
  double last = kInfinity;
  int growing = 0;
  ChainState chain = stateOf(chain_, loads, base_moment_, backbone);
  SweepResult s;
  for (int i = 0; i < max_sweeps && report.iterations < kMaxIterations; ++i) {
    ++report.iterations;
    backbone.passes->sweep(chain, nodes_hold_guess_ ? Pass::kOnce : Pass::kAnew, s);
    nodes_hold_guess_ = s.sound;
    const double error = std::max(s.change, bendingOf(Vector3(s.residual)));
    if (!s.sound || (growing += error > last) > 3) return false;
    if (!has_columns && i >= sweeps_before_columns) {
      SweepResult unchanged;
      backbone.passes->sweep(chain, Pass::kShape, unchanged);
      if (!(has_columns = updateInverse(loads, kRoughColumns, backbone))) return false;
    }
    const Vector3 step = -residual_inverse_ * Vector3(s.residual);
    base_moment_ += step;
    for (int k = 0; k < 3; ++k) chain.base_moment[k] = base_moment_[k];
    if (has_columns) backbone.passes->follow_all(chain, {step.x(), step.y(), step.z()});
    // A single sweep shows no rate: then that of the last solve counts, but not one that was quick by luck.
    if (i > 0) rate_ = std::max(kQuickestRate, std::min(kSlowestRate, error / last));  // 0 / 0: the slowest
    const double rate = i > 0 ? rate_ : std::max(rate_, 0.5 * kSlowestRate);
    const bool at_rounding = error <= kRounding && error > 0.3 * last;
    report.iteration = at_rounding ? error : rate * error;
    last = error;
    if (!has_columns || (report.iteration > goal && !at_rounding)) continue;
    backbone.passes->sweep(chain, Pass::kShape, s);
    report.residual = bendingOf(Vector3(s.residual));
    if (!(report.residual <= goal) && !at_rounding) continue;
    backbone.setTip(s.R_tip, s.p_tip);
    return true;
  }
  return false;
}

bool StaticsSolver::newton(const DeadLoads& loads, Backbone& backbone, int max_iterations, StaticsReport& report) {
  Vector3 m0 = base_moment_, accepted_m0 = m0, residual = Vector3::Zero();
  Vector3 step = residual, accepted_residual = residual;
  double accepted = kInfinity, damping = 1.0;
  bool have_inverse = warm_, inverse_is_fresh = false;
  const auto refresh = [&] {
    have_inverse = inverse_is_fresh = updateInverse(loads, kFineColumns, backbone);
  };
  for (int i = 0; i < max_iterations && report.iterations < kMaxIterations; ++i) {
    ++report.iterations;
    const bool marched = march(loads, m0, backbone, residual);
    report.residual = marched ? bendingOf(residual) : kInfinity;
    const bool stalled = report.residual <= kResidualAccepted && report.residual >= 0.5 * accepted && inverse_is_fresh;
    if (report.residual <= kResidualGoal || stalled) {
      report.iteration = 0.0;  // every shot has converged
      base_moment_ = m0;
      return true;
    }
    if (report.residual < accepted) {
      if (have_inverse && std::isfinite(accepted)) {
        // Broyden's update: the inverse maps the change of residual just seen to the step just made.
        const Vector3 change = residual_inverse_ * (residual - accepted_residual);
        const Vector3 made = m0 - accepted_m0;
        const double scale = made.dot(change);
        if (std::abs(scale) > 1e-3 * made.squaredNorm())
          residual_inverse_ += (made - change) * (made.transpose() * residual_inverse_) / scale;
      }
      if (!have_inverse || (report.residual > 0.1 * accepted && !stalled)) refresh();
      else inverse_is_fresh = false;
      accepted = report.residual;
      accepted_m0 = m0;
      accepted_residual = residual;
      damping = 1.0;
    } else if (std::isinf(accepted)) {
      return false;  // not even the first guess can be integrated
    } else if (!inverse_is_fresh) {
      if (!march(loads, accepted_m0, backbone, residual)) return false;
      refresh();
      damping = 1.0;
    } else {
      damping *= 0.5;
      if (damping < 1e-2) return false;
      m0 = accepted_m0 + damping * step;
      continue;
    }
    step = -residual_inverse_ * residual;
    if (!step.allFinite()) return false;
    m0 = accepted_m0 + damping * step;
  }
  return false;
}

void StaticsSolver::forgetGuesses(const DeadLoads& loads, Backbone& backbone) {
  prepare(chain_, loads, backbone);
  warm_ = has_columns_ = nodes_hold_guess_ = false;
  solutions_ = 0;
}

// The unloaded shape, and the base moment that the loads would exert on it.
void StaticsSolver::placeFresh(const DeadLoads& loads, Backbone& backbone) {
  live_stiffness::placeUnloaded(chain_, backbone);
  forgetGuesses(loads, backbone);
  nodes_hold_guess_ = true;
  base_moment_ = angular(loads.tip) + backbone.X_BT.p.cross(linear(loads.tip) + chain_.tip_mass * loads.gravity);
  const GaussLegendre& table = gaussLegendre(backbone.passes->stages);
  auto element = backbone.elements.begin();
  Pose X;
  for (const Chain::Part& part : chain_.parts) {
    if (part.segment < 0) {
      base_moment_ += (X.p + 0.5 * part.length * X.R.col(2)).cross(part.mass * loads.gravity);
      X.p += part.length * X.R.col(2);
      continue;
    }
    const int count = backbone.element_count[part.segment];
    for (int k = 0; k < count; ++k, ++element) {
      Vector3 centre = element->p_start();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < table.nodes; ++j) centre[i] += table.b[j] * element->state.offset[i][j];
      base_moment_ += centre.cross(part.mass / count * loads.gravity);
      X = element->X_end();
    }
  }
}

void StaticsSolver::prepareUnloaded(Backbone& backbone) {
  warm_ = has_columns_ = false;
  solutions_ = 0;
  amplification_ = 1.0;
  rate_ = kSlowestRate;
  discretisation_.chooseUnloaded(backbone);
  prepare(chain_, DeadLoads(), backbone);
}

// A guess from the last solutions. Where one pass over the columns is enough as it is, to extrapolate them does not
// pay.
void StaticsSolver::goOn(const DeadLoads& loads, Backbone& backbone) {
  constexpr double kOnePass = 1e-4;
  const History known = accuracy_ < kOnePass && has_columns_ ? History::kColumns : History::kShape;
  const bool has_history = solutions_ >= 2 && known == history_;
  const double steadiness = prepare(chain_, loads, backbone, known, has_history);
  history_ = known;
  const Vector3 last = base_moment_;
  base_moment_ += steadiness * (last - moment_before_);
  moment_before_ = last;
}

// By the quickest way that works, whichever branch that leads to.
bool StaticsSolver::findEquilibrium(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  Known known = !warm_ ? Known::kNothing : has_columns_ ? Known::kColumns : Known::kInverse;
  if (warm_) goOn(loads, backbone);
  else placeFresh(loads, backbone);
  while (true) {
    bool converged = quick(loads, known, kMaxSweeps, backbone, report);
    if (!converged) {
      placeFresh(loads, backbone);
      converged = newton(loads, backbone, 30, report);
    }
    if (!converged || !findTangent(loads, backbone, report)) return false;
    known = Known::kColumns;
    if (discretisation_.refine(report.amplification, backbone)) {
      forgetGuesses(loads, backbone);
      known = Known::kInverse;
    } else if (!((report.residual + report.iteration) * report.amplification > accuracy_) ||
               report.iterations >= kMaxIterations / 2) {
      return true;
    }
  }
}

// Settles to one load of a branch search, with more elements where the robot bends more by now.
class StaticsSolver::Finder : public EquilibriumFinder {
 public:
  Finder(StaticsSolver& solver, const DeadLoads& last, Backbone& backbone, StaticsReport& report)
      : solver_(solver), last_(last), backbone_(backbone), report_(report) {}

  std::optional<Equilibrium> settle(const DeadLoads& loads, const Vector3& base_moment) override {
    prepare(solver_.chain_, loads, backbone_);
    const bool is_last = loads.gravity == last_.gravity && loads.tip == last_.tip;
    Vector3 guess = base_moment;
    bool refined = false;
    do {
      if (!(settleQuickly(loads, guess, refined) || settleByNewton(loads, guess)) ||
          !solver_.findTangent(loads, backbone_, report_)) {
        solver_.forgetGuesses(loads, backbone_);
        return std::nullopt;
      }
      guess = solver_.base_moment_;
    } while ((refined = refine(loads, is_last ? solver_.accuracy_ : kRoughShape)));
    return Equilibrium{solver_.base_moment_, backbone_.X_BT.p, solver_.tangent_,
                       solver_.isStable(loads, backbone_, report_)};
  }
  double bendingOf(const Vector3& moment) const override { return solver_.bendingOf(moment); }
  bool exhausted() const override { return report_.iterations >= kMaxIterations; }

 private:
  // From the shape and the columns of the loads before, or from the base moment that fewer elements have led to.
  bool settleQuickly(const DeadLoads& loads, const Vector3& base_moment, bool refined) {
    // Of rods that the loads bend little sweeps converge surely. Under more load a base moment must be known to more
    // digits than they give, and Newton's method is not to be kept waiting.
    constexpr double kLittle = 3.0;  // load number
    const bool is_little = loadNumber(solver_.chain_, loads, backbone_) < kLittle;
    const int few_sweeps = is_little ? 30 : 12;
    const double far_from_buckling = is_little ? 8.0 : 4.0;  // amplification
    const bool has_columns = solver_.nodes_hold_guess_ && solver_.has_columns_;
    if (!(has_columns || refined) || solver_.amplification_ > far_from_buckling) return false;
    if (has_columns) {
      const Vector3 step = base_moment - solver_.base_moment_;
      const ChainState chain = stateOf(solver_.chain_, loads, base_moment, backbone_);
      backbone_.passes->follow_all(chain, {step.x(), step.y(), step.z()});
    }
    solver_.base_moment_ = base_moment;
    const int before = report_.iterations;
    const Known known = has_columns ? Known::kColumns : Known::kInverse;
    const bool settled = solver_.quick(loads, known, few_sweeps, backbone_, report_);
    report_.iterations = before + 1;  // as much work as one converged shot
    return settled;
  }
  bool settleByNewton(const DeadLoads& loads, const Vector3& base_moment) {
    solver_.base_moment_ = base_moment;
    solver_.warm_ = false;
    return solver_.newton(loads, backbone_, 12, report_);
  }
  bool refine(const DeadLoads& loads, double tolerated) {
    if (!solver_.discretisation_.refine(report_.amplification, backbone_, tolerated)) return false;
    solver_.forgetGuesses(loads, backbone_);
    return true;
  }

  StaticsSolver& solver_;
  const DeadLoads& last_;
  Backbone& backbone_;
  StaticsReport& report_;
};

// Sweeps to the finest goal from a solution; takes it back if they fail.
void StaticsSolver::polish(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  const Vector3 before = base_moment_;
  StaticsReport finer;
  if (quick(loads, Known::kColumns, kMaxSweeps, backbone, finer) && findTangent(loads, backbone, finer)) {
    report.residual = finer.residual;
    report.iteration = finer.iteration;
  } else {
    Vector3 residual;
    base_moment_ = before;
    forgetGuesses(loads, backbone);
    report.stable = march(loads, before, backbone, residual) && findTangent(loads, backbone, report);
  }
  report.iterations += finer.iterations;
}

bool StaticsSolver::findAlongLoads(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  discretisation_.choose(loads, backbone);
  placeFresh(DeadLoads(), backbone);
  Finder finder(*this, loads, backbone, report);
  BranchSearch search(finder, length_);
  const BranchEnd end = search.run(loads);
  report.buckled = end == BranchEnd::kBuckled;
  report.stable = report.buckled || end == BranchEnd::kLoading;
  report.stable_share = search.stableShare();
  if (report.stable && (report.residual + report.iteration) * report.amplification > accuracy_)
    polish(loads, backbone, report);
  return end != BranchEnd::kNotConverged;
}

// Columns with a relative error x give a compliance with an error of about x. But the linearised rod is its own adjoint
// as long as no tip moment acts, so the work of one wrench's moments on what another one's columns miss (their defect)
// is that error to first order; without it x^2 is left. See docs/derivation.md.
//
// On a long taut chain the columns are far larger than the compliance made of them, as they are near a fold. Then so
// much of x, and of rounding, is left, too.
bool StaticsSolver::findTangent(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  constexpr double kRounding = 2e-16;
  constexpr double kEnough = 2.0;  // growth is known afterwards only; seldom does a little of it take another round
  const double goal = 0.2 * accuracy_, shape = report.iteration;
  const bool self_adjoint = angular(loads.tip).isZero(0.0);
  double cancellation = 1.0, growth_squared = 1.0;  // of linear columns alone, and of all
  for (int attempt = 0; attempt < 2; ++attempt) {
    ElementColumns tip;
    const double error_goal = std::max(goal / amplification_, 1e-16);
    const double column_goal = self_adjoint ? std::sqrt(2.0 * error_goal / (amplification_ * growth_squared))
                                            : error_goal / cancellation;
    const double change = tipColumns(chain_, loads, !has_columns_, column_goal, backbone, tip, self_adjoint);
    has_columns_ = std::isfinite(change);
    if (!has_columns_) return false;
    backbone.passes->tangent(tip, self_adjoint, residual_inverse_.data(), tangent_.data());
    if (!std::isfinite(tangent_.sum())) return false;
    amplification_ =
        std::clamp(tangent_.diagonal().tail<3>().cwiseAbs().maxCoeff() / stiffest_, 1.0, kMostAmplification);
    const double p = columnsOf(tip.p).rightCols<3>().squaredNorm(), m = columnsOf(tip.m).leftCols<3>().squaredNorm(),
                 phi = columnsOf(tip.phi).leftCols<3>().squaredNorm(), inverse = residual_inverse_.squaredNorm();
    const double linear_part = std::max(1.0, p / tangent_.topLeftCorner<3, 3>().squaredNorm());
    // Without loads both are 1. Towards a bifurcation the condition grows as the amplification, which counts anyway.
    const double angular_part = phi * inverse / (3.0 * tangent_.bottomRightCorner<3, 3>().squaredNorm());
    const double condition = m * inverse / (9.0 * amplification_ * amplification_);
    cancellation = std::sqrt(linear_part);
    growth_squared = std::max(linear_part, angular_part);
    const double left =
        self_adjoint ? 0.5 * change * change * growth_squared * amplification_ : change * cancellation;
    report.iteration = shape + left;
    report.rounding = kRounding * std::sqrt(growth_squared * std::max(1.0, condition));
    report.truncation = discretisation_.truncation(cancellation, backbone);
    if (left * amplification_ <= kEnough * goal) break;
  }
  report.amplification = amplification_;
  return true;
}

bool StaticsSolver::isStable(const DeadLoads& loads, const Backbone& backbone, const StaticsReport& report) const {
  return isTipStable(tangent_, softness_, report.relativeError()) &&
         !(mayBuckle(loads, backbone) && hasConjugatePoint(backbone));
}

bool StaticsSolver::mayBuckle(const DeadLoads& loads, const Backbone& backbone) const {
  return !(loadNumber(chain_, loads, backbone) < 1.0);  // NaN, too
}

StaticsReport StaticsSolver::solve(const DeadLoads& loads, Backbone& backbone) {
  StaticsReport report;
  softness_ = stiffest_ = 0.0;
  for (const Chain::Part& part : chain_.parts)
    if (part.segment >= 0) {
      const RestState& rest = backbone.rest[part.segment];
      const double length = rest.stretch * part.length;
      softness_ = std::max(softness_, rest.c.bending_torsion.diagonal().maxCoeff() * length);
      stiffest_ += rest.c.bending_torsion.diagonal().minCoeff() * length;
    }
  // Other elements hold no guess, but the base moment stays what it was.
  if (discretisation_.choose(loads, backbone)) {
    has_columns_ = nodes_hold_guess_ = false;
    solutions_ = 0;
  }
  // Newton's method takes any equilibrium, if it finds one. So where there may be several it is trusted near a stable
  // one only.
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
