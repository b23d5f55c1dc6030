#include "live_stiffness/rod/statics.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "live_stiffness/rod/conjugate_points.h"
#include "live_stiffness/rod/kinematics.h"

namespace live_stiffness {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kResidualGoal = 1e-12;     // rad, see StaticsReport::residual
constexpr double kResidualAccepted = 1e-9;  // rad, when rounding stops it short of the goal

}  // namespace

StaticsSolver::StaticsSolver(const Scene& scene, double accuracy) : scene_(scene), accuracy_(accuracy) {}

bool StaticsSolver::march(const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone, Vector3& residual) {
  nodes_hold_guess_ = shoot(scene_, loads, base_moment, nodes_hold_guess_, backbone, residual);
  return nodes_hold_guess_;
}

double StaticsSolver::bendingOf(const Vector3& moment, const Backbone& backbone) const {
  double softest = 0.0;
  walk(
      scene_,
      [&](int index, const Segment& segment) {
        const RestState& rest = backbone.rest[index];
        softest = std::max(softest, rest.c.bending_torsion.diagonal().maxCoeff() * rest.stretch * segment.length);
      },
      [](const Link&) {});
  return softest * moment.norm();
}

bool StaticsSolver::newton(const DeadLoads& loads, Backbone& backbone, int max_iterations, StaticsReport& report) {
  Vector3 m0 = base_moment_, accepted_m0 = m0, residual = Vector3::Zero();
  Vector3 step = residual, accepted_residual = residual;
  double accepted = kInfinity, damping = 1.0;
  bool have_inverse = warm_, inverse_is_fresh = false;
  const auto refresh = [&] {
    residual_inverse_ = tipColumns(scene_, loads, backbone).m.leftCols<3>().inverse();
    have_inverse = inverse_is_fresh = true;
  };
  for (int i = 0; i < max_iterations && report.iterations < kMaxIterations; ++i) {
    ++report.iterations;
    const bool marched = march(loads, m0, backbone, residual);
    report.residual = marched ? bendingOf(residual, backbone) : kInfinity;
    const bool stalled = report.residual <= kResidualAccepted && report.residual >= 0.5 * accepted && inverse_is_fresh;
    if (report.residual <= kResidualGoal || stalled) {
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

// The unloaded shape, and the base moment that the loads would exert on it.
void StaticsSolver::placeFresh(const DeadLoads& loads, Backbone& backbone) {
  placeUnloaded(scene_, backbone);
  nodes_hold_guess_ = true;
  warm_ = false;
  base_moment_ = angular(loads.tip) + backbone.X_BT.p.cross(linear(loads.tip) + scene_.tip_mass * loads.gravity);
  auto element = backbone.elements.begin();
  Pose X;
  walk(
      scene_,
      [&](int index, const Segment& segment) {
        const Vector3 line_load = lineLoad(segment, backbone.rest[index], loads);
        for (int k = 0; k < backbone.element_count[index]; ++k, ++element)
          for (int i = 0; i < kStages; ++i) base_moment_ += element->weight(i) * element->X[i].p.cross(line_load);
        X = std::prev(element)->X_end;
      },
      [&](const Link& link) {
        base_moment_ += (X.p + 0.5 * link.length * X.R.col(2)).cross(link.mass * loads.gravity);
        X.p += link.length * X.R.col(2);
      });
}

// Elements by bending at rest and by the load number L sqrt(|n| c_bt): about what one element of order 12 carries.
void StaticsSolver::chooseElements(const DeadLoads& loads, Backbone& backbone) const {
  const double bending_an_element = 1.2 * std::pow(accuracy_ / 1e-9, 1.0 / (2 * kStages));
  const double load_number_an_element = 0.8 * bending_an_element;
  const double force = baseForce(scene_, loads).norm();
  const double moment = angular(loads.tip).norm();
  walk(
      scene_,
      [&](int index, const Segment& segment) {
        const RestState& rest = backbone.rest[index];
        const double length = rest.stretch * segment.length;
        const double softness = rest.c.bending_torsion.diagonal().maxCoeff();
        const double bending = length * (rest.curvature.norm() + softness * moment) / bending_an_element;
        const double load = length * std::sqrt(softness * force) / load_number_an_element;
        const double count = std::ceil(std::max(bending, load));
        backbone.element_count[index] = static_cast<int>(std::clamp(count, 1.0, Backbone::kMaxElements / 2.0));
      },
      [](const Link&) {});
}

// Doubles the elements of every segment whose estimated error is above its share. False when there is none to double.
bool StaticsSolver::refine(Backbone& backbone, StaticsReport& report) const {
  report.truncation = 0.0;
  bool refined = false;
  auto element = backbone.elements.begin();
  for (int& count : backbone.element_count) {
    double error = 0.0;
    for (int k = 0; k < count; ++k, ++element) error += 4.0 * element->truncation * element->truncation;
    report.truncation += error;
    if (error > accuracy_ && 2 * count <= Backbone::kMaxElements) {
      count *= 2;
      refined = true;
    }
  }
  return refined;
}

// True if the number of elements is not what element_count says; they then hold no guess.
bool StaticsSolver::resizeElements(Backbone& backbone) {
  const size_t total = std::accumulate(backbone.element_count.begin(), backbone.element_count.end(), 0);
  if (total == backbone.elements.size()) return false;
  backbone.elements.resize(total);
  nodes_hold_guess_ = false;
  return true;
}

// By the quickest way that works, whichever branch that leads to.
bool StaticsSolver::findEquilibrium(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  bool converged;
  do {
    resizeElements(backbone);
    const bool was_warm = warm_;
    if (!warm_) placeFresh(loads, backbone);
    converged = newton(loads, backbone, 20, report);
    if (!converged && was_warm) {
      placeFresh(loads, backbone);
      converged = newton(loads, backbone, 30, report);
    }
    warm_ = converged;
  } while (converged && refine(backbone, report));
  return converged && findTangent(loads, backbone);
}

// Settles to one load of a branch search, with more elements where the robot bends more by now.
class StaticsSolver::Finder : public EquilibriumFinder {
 public:
  Finder(StaticsSolver& solver, Backbone& backbone, StaticsReport& report)
      : solver_(solver), backbone_(backbone), report_(report) {}

  std::optional<Equilibrium> settle(const DeadLoads& loads, const Vector3& base_moment) override {
    solver_.base_moment_ = base_moment;
    do {
      solver_.resizeElements(backbone_);
      solver_.warm_ = false;
      if (!solver_.newton(loads, backbone_, 12, report_)) {
        solver_.nodes_hold_guess_ = false;
        return std::nullopt;
      }
    } while (solver_.refine(backbone_, report_));
    if (!solver_.findTangent(loads, backbone_)) return std::nullopt;
    return Equilibrium{solver_.base_moment_, backbone_.X_BT.p, solver_.tangent_, solver_.isStable(loads, backbone_, report_)};
  }
  double bendingOf(const Vector3& moment) const override { return solver_.bendingOf(moment, backbone_); }
  bool exhausted() const override { return report_.iterations >= kMaxIterations; }

 private:
  StaticsSolver& solver_;
  Backbone& backbone_;
  StaticsReport& report_;
};

bool StaticsSolver::findAlongLoads(const DeadLoads& loads, Backbone& backbone, StaticsReport& report) {
  chooseElements(loads, backbone);
  resizeElements(backbone);
  placeFresh(DeadLoads(), backbone);
  Finder finder(*this, backbone, report);
  BranchSearch search(finder, scene_.length());
  const BranchEnd end = search.run(loads);
  report.buckled = end == BranchEnd::kBuckled;
  report.stable = report.buckled || end == BranchEnd::kLoading;
  report.stable_share = search.stableShare();
  return end != BranchEnd::kNotConverged;
}

bool StaticsSolver::findTangent(const DeadLoads& loads, const Backbone& backbone) {
  const StateColumns tip = tipColumns(scene_, loads, backbone);
  residual_inverse_ = tip.m.leftCols<3>().inverse();
  // dm0 = A^-1 (dM - B df), from the residual's columns [A, B]; C maps [df; dM] to the twist of T.
  const Matrix3 m0_of_force = -residual_inverse_ * tip.m.rightCols<3>();
  tangent_.topLeftCorner<3, 3>() = tip.p.rightCols<3>() + tip.p.leftCols<3>() * m0_of_force;
  tangent_.topRightCorner<3, 3>() = tip.p.leftCols<3>() * residual_inverse_;
  tangent_.bottomLeftCorner<3, 3>() = tip.phi.rightCols<3>() + tip.phi.leftCols<3>() * m0_of_force;
  tangent_.bottomRightCorner<3, 3>() = tip.phi.leftCols<3>() * residual_inverse_;
  return tangent_.allFinite();
}

bool StaticsSolver::isStable(const DeadLoads& loads, const Backbone& backbone, const StaticsReport& report) const {
  // Of a neutral equilibrium rounding, or the error of discretisation, decides what is left of the compliance. So it
  // must not be larger than that of the softest segment by more than leaves a digit.
  const double neutral = std::min(1e7, 0.1 / (report.truncation + report.residual));
  // Of a rod without elongation the compliance is singular, and rounding decides its sign. Beyond buckling the negative
  // part is as large as the loads are small.
  constexpr double kRounding = 1e-11;
  Matrix6 symmetric_part = 0.5 * (tangent_ + tangent_.transpose());
  const double translation = symmetric_part.topLeftCorner<3, 3>().trace();
  const double rotation = symmetric_part.bottomRightCorner<3, 3>().trace();
  if (!(translation > 0.0) || !(rotation < neutral * bendingOf(Vector3::UnitX(), backbone))) return false;
  symmetric_part.diagonal().head<3>().array() += kRounding * translation;
  symmetric_part.diagonal().tail<3>().array() += kRounding * rotation;
  return symmetric_part.llt().info() == Eigen::Success &&
         !(mayBuckle(loads, backbone) && hasConjugatePoint(scene_, loads, backbone));
}

// False if the loads are so small that there is one equilibrium only: below 1, this bounds the ratio of load and buckling
// load of the straight robot from above, by the trace of int |n| int c ds dl (exact for a soft hinge, 0.81 for a uniform
// column under a tip load). A tip moment alone winds the rod up by half a turn before it has a choice.
bool StaticsSolver::mayBuckle(const DeadLoads& loads, const Backbone& backbone) const {
  Vector3 n = baseForce(scene_, loads);
  double softness = 0.0, load_number = 0.0;  // of all before, rad / (N m)
  walk(
      scene_,
      [&](int index, const Segment& segment) {
        const RestState& rest = backbone.rest[index];
        const double length = rest.stretch * segment.length;
        const double own = rest.c.bending_torsion.diagonal().maxCoeff() * length;
        load_number += n.norm() * length * (softness + 0.5 * own);
        softness += own;
        n -= segment.mass() * loads.gravity;
      },
      [&](const Link& link) {
        load_number += n.norm() * link.length * softness;
        n -= link.mass * loads.gravity;
      });
  load_number += n.norm() * scene_.tip_offset.norm() * softness + angular(loads.tip).norm() * softness / kPi;
  return !(load_number < 1.0);
}

StaticsReport StaticsSolver::solve(const DeadLoads& loads, Backbone& backbone) {
  StaticsReport report;
  chooseElements(loads, backbone);
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
  return report;
}

}  // namespace live_stiffness
