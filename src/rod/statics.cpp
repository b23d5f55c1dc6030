#include "live_stiffness/rod/statics.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "live_stiffness/rod/kinematics.h"

namespace live_stiffness {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kResidualGoal = 1e-12;     // rad, see StaticsReport::residual
constexpr double kResidualAccepted = 1e-9;  // rad, when rounding stops it short of the goal
constexpr double kRoughColumns = 1e-2;      // relative change, enough for Newton steps

}  // namespace

StaticsSolver::StaticsSolver(const Scene& scene, double accuracy, int stages)
    : chain_(scene), accuracy_(accuracy), discretisation_(chain_, accuracy, stages) {}

bool StaticsSolver::march(const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone, Vector3& residual) {
  if (shoot(chain_, loads, base_moment, backbone, residual)) return true;
  resetGuesses(loads, backbone);
  return false;
}

bool StaticsSolver::updateInverse(const DeadLoads& loads, double goal, Backbone& backbone) {
  ElementColumns columns;
  const double change = tipColumns(chain_, loads, !has_columns_, goal, backbone, columns);
  has_columns_ = std::isfinite(change);
  residual_inverse_ = columnsOf(columns.m).leftCols<3>().inverse();
  return has_columns_ && residual_inverse_.allFinite();
}

// Sweeps of one pass an element, each followed by a step of the base moment with the kept inverse: shape and moment
// converge together, linearly, by a factor of about ten a sweep. Without trouble it takes three to ten.
bool StaticsSolver::quick(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  constexpr int kMaxSweeps = 40, kSweepsBeforeInverse = 2;
  constexpr double kSlowestRate = 0.2, kRounding = 1e-13;
  const double goal = std::max(0.2 * accuracy_, 1e-15);
  bool has_inverse = warm_;
  if (!has_inverse) residual_inverse_.setIdentity();  // right but for the load's own effect
  double last = kInfinity, expected = kInfinity;
  int growing = 0;
  for (int i = 0; i < kMaxSweeps; ++i) {
    const bool make_inverse = !has_inverse && i >= kSweepsBeforeInverse;
    const bool finish = expected <= goal || make_inverse;
    ++report.iterations;
    const Sweep s = sweep(chain_, loads, base_moment_, finish, backbone);
    report.residual = bendingOf(s.residual);
    const double error = std::max(s.change, report.residual);
    if (!s.sound || (growing += error > last) > 3) return false;
    // A sweep leaves in the shape about its change times the rate at which changes shrink; the residual it leaves.
    const double rate = i == 0 ? 0.5 * kSlowestRate : std::min(kSlowestRate, error / last);
    expected = error * rate;
    report.iteration = s.change * rate;
    const bool at_rounding = error <= kRounding && error >= 0.5 * last;
    if (finish && has_inverse && (std::max(report.iteration, report.residual) <= goal || at_rounding)) return true;
    if (error <= kRounding && error > 0.3 * last) expected = 0.0;
    last = error;
    if (make_inverse && !(has_inverse = updateInverse(loads, kRoughColumns, backbone))) return false;
    const Vector3 step = -residual_inverse_ * s.residual;
    base_moment_ += step;
    if (!has_inverse) continue;
    for (RodElement& element : backbone.elements) backbone.passes->follow(element.state, {step.x(), step.y(), step.z()});
  }
  return false;
}

bool StaticsSolver::newton(const DeadLoads& loads, Backbone& backbone, int max_iterations, StaticsReport& report) {
  Vector3 m0 = base_moment_, accepted_m0 = m0, residual = Vector3::Zero();
  Vector3 step = residual, accepted_residual = residual;
  double accepted = kInfinity, damping = 1.0;
  bool have_inverse = warm_, inverse_is_fresh = false;
  const auto refresh = [&] {
    have_inverse = inverse_is_fresh = updateInverse(loads, kRoughColumns, backbone);
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

// Loads grow from zero in steps of adaptive size. The base moment of the next step is extrapolated from the last three:
// on a long hanging chain a shot strays exponentially, so that a moment scaled with the load would not do.
bool StaticsSolver::continuation(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  std::array<double, 3> reached = {0.0, 0.0, 0.0};  // fractions of the load, newest first
  std::array<Vector3, 3> moments = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  int known = 1;  // without load there is no moment
  double advance = 0.25;
  while (reached[0] < 1.0) {
    const double trial = std::min(1.0, reached[0] + advance);
    base_moment_.setZero();
    for (int i = 0; i < known; ++i) {
      double weight = 1.0;  // Lagrange's
      for (int j = 0; j < known; ++j)
        if (j != i) weight *= (trial - reached[j]) / (reached[i] - reached[j]);
      base_moment_ += weight * moments[i];
    }
    warm_ = false;
    prepare(chain_, loads.scaled(trial), backbone);
    if (newton(loads.scaled(trial), backbone, 12, report)) {
      for (int i = 2; i > 0; --i) {
        reached[i] = reached[i - 1];
        moments[i] = moments[i - 1];
      }
      reached[0] = trial;
      moments[0] = base_moment_;
      known = std::min(known + 1, 3);
      advance *= 1.5;
    } else {
      advance *= 0.5;
      resetGuesses(loads.scaled(trial), backbone);
    }
    if (advance < 1e-3 || report.iterations >= kMaxIterations) return false;
  }
  return true;
}

void StaticsSolver::resetGuesses(const DeadLoads& loads, Backbone& backbone) {
  live_stiffness::placeUnloaded(chain_, backbone);
  prepare(chain_, loads, backbone);
  warm_ = has_columns_ = false;
}

// The unloaded shape, and the base moment that the loads would exert on it.
void StaticsSolver::placeFresh(const DeadLoads& loads, Backbone& backbone) {
  resetGuesses(loads, backbone);
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
      Vector3 centre = element->p_start;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < table.nodes; ++j) centre[i] += table.b[j] * element->state.offset[i][j];
      base_moment_ += centre.cross(part.mass / count * loads.gravity);
      X = element->X_end();
    }
  }
}

void StaticsSolver::placeUnloaded(Backbone& backbone) {
  warm_ = has_columns_ = false;
  discretisation_.chooseUnloaded(backbone);
  live_stiffness::placeUnloaded(chain_, backbone);
}

// along_loads: by load continuation from the unloaded shape alone, otherwise by the quickest way that works.
bool StaticsSolver::findEquilibrium(const DeadLoads& loads, bool along_loads, Backbone& backbone,
                                    StaticsReport& report) {
  bool converged;
  do {
    if (!warm_) placeFresh(loads, backbone);
    else prepare(chain_, loads, backbone);
    converged = !along_loads && quick(loads, backbone, report);
    if (!converged && !along_loads) {
      placeFresh(loads, backbone);
      converged = newton(loads, backbone, 30, report);
    }
    if (!converged) {
      placeFresh(loads, backbone);
      converged = continuation(loads, backbone, report);
    }
    report.truncation = discretisation_.truncation(backbone);
    warm_ = false;
  } while (converged && discretisation_.refine(backbone));
  return converged;
}

bool StaticsSolver::findTangent(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  ElementColumns tip;
  const double change = tipColumns(chain_, loads, !has_columns_, std::max(0.3 * accuracy_, 1e-14), backbone, tip);
  has_columns_ = std::isfinite(change);
  if (!has_columns_) return false;
  report.iteration += change;
  const auto phi = columnsOf(tip.phi), p = columnsOf(tip.p), m = columnsOf(tip.m);
  residual_inverse_ = m.leftCols<3>().inverse();
  // dm0 = A^-1 (dM - B df), from the residual's columns [A, B]; C maps [df; dM] to the twist of T.
  const Matrix3 m0_of_force = -residual_inverse_ * m.rightCols<3>();
  tangent_.topLeftCorner<3, 3>() = p.rightCols<3>() + p.leftCols<3>() * m0_of_force;
  tangent_.topRightCorner<3, 3>() = p.leftCols<3>() * residual_inverse_;
  tangent_.bottomLeftCorner<3, 3>() = phi.rightCols<3>() + phi.leftCols<3>() * m0_of_force;
  tangent_.bottomRightCorner<3, 3>() = phi.leftCols<3>() * residual_inverse_;
  return tangent_.allFinite();
}

// Positive definite: all pivots of L D L^T are positive.
bool StaticsSolver::isStable() const {
  Matrix6 a = 0.5 * (tangent_ + tangent_.transpose());
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    if (!(a(k, k) > 0.0)) return false;
    const double inverse = 1.0 / a(k, k);
#pragma GCC unroll 6
    for (int j = k + 1; j < 6; ++j) {
      const double factor = a(j, k) * inverse;
#pragma GCC unroll 6
      for (int i = j; i < 6; ++i) a(i, j) -= factor * a(i, k);
    }
  }
  return true;
}

StaticsReport StaticsSolver::solve(const DeadLoads& loads, Backbone& backbone) {
  StaticsReport report;
  softness_ = 0.0;
  for (const Chain::Part& part : chain_.parts)
    if (part.segment >= 0) {
      const RestState& rest = backbone.rest[part.segment];
      softness_ = std::max(softness_, rest.c.bending_torsion.diagonal().maxCoeff() * rest.stretch * part.length);
    }
  if (discretisation_.choose(loads, backbone)) warm_ = has_columns_ = false;
  report.converged = findEquilibrium(loads, false, backbone, report) && findTangent(loads, backbone, report);
  report.stable = report.converged && isStable();
  if (report.converged && !report.stable) {
    // Newton's method takes any equilibrium; the one that the robot sags to as its loads grow is more likely stable.
    StaticsReport second;
    warm_ = has_columns_ = false;
    second.converged = findEquilibrium(loads, true, backbone, second) && findTangent(loads, backbone, second);
    second.stable = second.converged && isStable();
    second.iterations += report.iterations;
    report = second;
  }
  warm_ = report.converged && report.stable;
  return report;
}

}  // namespace live_stiffness
