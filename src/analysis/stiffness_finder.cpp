#include "analysis/stiffness_finder.h"

#include <nlopt.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include "live_stiffness/analysis/directional_stiffness.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

using Unknowns = Eigen::VectorXd;  // channel pressures divided by the largest allowed one, 0 to 1
constexpr double kStep = 1e-4;     // of central differences

struct Derivatives {
  FoundPressures at;
  Eigen::Matrix3Xd position;    // d p / d x, m
  Eigen::VectorXd log_stiffness;  // d ln(k) / d x
};

// The robot as a function of the unknowns.
struct Problem {
  const StiffnessModel& model;
  const ChannelMap& channels;
  const Vector3& point;
  Line along;  // through the tip
  const FinderOptions& options;
  StiffnessWorkspace workspace = model.makeWorkspace();
  Pressures chambers = Pressures::Zero(channels.chamberCount());
  long solves = 0;

  std::optional<FoundPressures> solve(const Unknowns& x) {
    FoundPressures found;
    found.channels = options.max_pressure * x;
    channels.expandInto(found.channels, chambers);
    workspace.reset();
    ++solves;
    const StiffnessSolution solution = model.solve(chambers, Wrench::Zero(), workspace);
    if (!solution.status.ok()) return std::nullopt;
    found.X_BT = solution.X_BT;
    found.miss = (solution.X_BT.p - point).norm();
    found.stiffness = freeStiffnessAlong(solution.compliance, along);
    if (!(found.stiffness > 0.0)) return std::nullopt;
    return found;
  }

  std::optional<Derivatives> derivatives(const Unknowns& x) {
    const std::optional<FoundPressures> at = solve(x);
    if (!at) return std::nullopt;
    Derivatives d{*at, Eigen::Matrix3Xd(3, x.size()), Eigen::VectorXd(x.size())};
    for (int k = 0; k < x.size(); ++k) {
      const Unknowns step = kStep * Unknowns::Unit(x.size(), k);
      const std::optional<FoundPressures> above = solve(x + step), below = solve(x - step);
      if (!above || !below) return std::nullopt;
      d.position.col(k) = (above->X_BT.p - below->X_BT.p) / (2.0 * kStep);
      d.log_stiffness[k] = std::log(above->stiffness / below->stiffness) / (2.0 * kStep);
    }
    return d;
  }
};

// Levenberg-Marquardt on the distance to the point. An unknown at its bound stays there if the step would cross it.
std::optional<FoundPressures> approach(Problem& problem, Unknowns& x) {
  std::optional<Derivatives> d = problem.derivatives(x);
  double damping = 1e-3;
  for (int iteration = 0; d && iteration < 60 && d->at.miss > 1e-9; ++iteration) {
    const Vector3 residual = d->at.X_BT.p - problem.point;
    Eigen::Matrix3Xd J = d->position;
    const Unknowns slope = J.transpose() * residual;
    for (int k = 0; k < x.size(); ++k)
      if ((x[k] <= 0.0 && slope[k] > 0.0) || (x[k] >= 1.0 && slope[k] < 0.0)) J.col(k).setZero();
    const double size = J.squaredNorm();
    bool improved = false;
    for (int attempt = 0; attempt < 12 && !improved && size > 0.0; ++attempt) {
      const Matrix3 normal = J * J.transpose() + damping * size * Matrix3::Identity();
      const Unknowns next = (x - J.transpose() * normal.llt().solve(residual)).cwiseMax(0.0).cwiseMin(1.0);
      const auto found = problem.solve(next);
      improved = found && found->miss < d->at.miss * (1.0 - 1e-9);
      if (improved) {
        const auto moved = problem.derivatives(next);
        if (!moved) return found;
        x = next;
        d = moved;
        damping = std::max(0.1 * damping, 1e-12);
      } else {
        damping *= 10.0;
      }
    }
    if (!improved) break;
  }
  if (!d) return std::nullopt;
  return d->at;
}

// A run of SLSQP for the stiffest (sign 1) or softest (-1) configuration. Keeps the best one within the tolerance that it
// visits.
struct Improver {
  Problem& problem;
  double sign;
  FoundPressures& best;
  double tolerance = problem.options.tolerance;
  nlopt_opt optimiser = nullptr;
  Unknowns last_x = {};
  std::optional<Derivatives> last = std::nullopt;

  void run(Unknowns x) {
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> owner(
        nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(x.size())), nlopt_destroy);
    optimiser = owner.get();
    nlopt_set_lower_bounds1(optimiser, 0.0);
    nlopt_set_upper_bounds1(optimiser, 1.0);
    nlopt_set_min_objective(optimiser, objective, this);
    const double goals[3] = {1e-3, 1e-3, 1e-3};
    nlopt_add_equality_mconstraint(optimiser, 3, constraint, this, goals);
    nlopt_set_xtol_abs1(optimiser, 1e-7);
    nlopt_set_maxeval(optimiser, 150);
    double value = 0.0;
    nlopt_optimize(optimiser, x.data(), &value);  // its return value does not matter: the result is in `best`
    // Its last configuration may be slightly off the point: correct that.
    x = x.cwiseMax(0.0).cwiseMin(1.0);
    if (x.allFinite())
      if (const auto found = approach(problem, x)) consider(*found);
  }

  void consider(const FoundPressures& found) {
    if (found.miss <= tolerance && sign * found.stiffness > sign * best.stiffness) best = found;
  }

  bool update(unsigned size, const double* x) {
    const Eigen::Map<const Unknowns> wanted(x, size);
    if (last && last_x == wanted) return true;
    last_x = wanted;
    last = problem.derivatives(last_x);
    if (!last) {
      nlopt_force_stop(optimiser);
      return false;
    }
    // Only configurations exactly at the point: others within the tolerance could be stiffer because they are off.
    if (last->at.miss <= 1e-3 * tolerance) consider(last->at);
    return true;
  }

  static double objective(unsigned size, const double* x, double* gradient, void* self) {
    Improver& me = *static_cast<Improver*>(self);
    if (!me.update(size, x)) return 0.0;
    if (gradient) Eigen::Map<Unknowns>(gradient, size) = -me.sign * me.last->log_stiffness;
    return -me.sign * std::log(me.last->at.stiffness);
  }

  // In units of ten tolerances.
  static void constraint(unsigned, double* result, unsigned size, const double* x, double* gradient, void* self) {
    using Gradient = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
    Improver& me = *static_cast<Improver*>(self);
    if (!me.update(size, x)) {
      std::fill_n(result, 3, 0.0);
      if (gradient) std::fill_n(gradient, 3 * size, 0.0);
      return;
    }
    const double scale = 0.1 / me.tolerance;
    Eigen::Map<Vector3> value(result);
    value = scale * (me.last->at.X_BT.p - me.problem.point);
    if (gradient) Eigen::Map<Gradient>(gradient, 3, size) = scale * me.last->position;
  }
};

void check(const StiffnessModel& model, const ChannelMap& channels, const Vector3& point, const Vector3& direction,
           const FinderOptions& options) {
  FaultList faults("search for pressures");
  if (channels.chamberCount() != model.scene().chamberCount())
    faults.add("the channels feed " + std::to_string(channels.chamberCount()) + " chambers, but the scene has " +
               std::to_string(model.scene().chamberCount()) + ": name the channel of each chamber");
  for (int i = 0; i < 3; ++i) faults.check("point (m)", point[i], Range::finite());
  if (!(direction.norm() > 0.0) || !direction.allFinite()) faults.add("direction: must be finite and not zero");
  faults.check("largest pressure (Pa)", options.max_pressure, Range::positive());
  faults.check("tolerance (m)", options.tolerance, {1e-8, 1.0});
  faults.check("starts", options.starts, {1.0, 1e6});
  faults.throwIfAny();
}

}  // namespace

FinderResult findPressures(const StiffnessModel& model, const ChannelMap& channels, const Vector3& point,
                           const Vector3& direction, const FinderOptions& options) {
  check(model, channels, point, direction, options);
  Problem problem{model, channels, point, {Vector3::Zero(), direction}, options};
  FinderResult result;
  std::mt19937_64 engine(options.seed);
  std::vector<Unknowns> arrived;
  for (int i = 0; i <= options.starts; ++i) {
    Unknowns x = Unknowns::Constant(channels.channelCount(), 0.5);
    if (i > 0)
      for (int k = 0; k < x.size(); ++k) x[k] = static_cast<double>(engine() >> 11) * 0x1.0p-53;
    const std::optional<FoundPressures> found = approach(problem, x);
    if (!found) continue;
    if (!result.solvable || found->miss < result.nearest.miss) result.nearest = *found;
    result.solvable = true;
    if (found->miss > options.tolerance) continue;
    arrived.push_back(found->channels / options.max_pressure);
    if (!result.reached || found->stiffness > result.stiffest.stiffness) result.stiffest = *found;
    if (!result.reached || found->stiffness < result.softest.stiffness) result.softest = *found;
    result.reached = true;
  }
  for (const Unknowns& x : arrived) {
    Improver{problem, 1.0, result.stiffest}.run(x);
    Improver{problem, -1.0, result.softest}.run(x);
  }
  result.solves = problem.solves;
  return result;
}

}  // namespace live_stiffness
