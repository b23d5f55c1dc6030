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
class Problem {
 public:
  Problem(const StiffnessModel& model, const ChannelMap& channels, const Vector3& point, const Vector3& direction,
          const FinderOptions& options)
      : model_(model),
        channels_(channels),
        point_(point),
        direction_(direction.normalized()),
        options_(options),
        workspace_(model.makeWorkspace()),
        chambers_(channels.chamberCount()) {}

  int size() const { return channels_.channelCount(); }
  long solves() const { return solves_; }
  const Vector3& point() const { return point_; }

  std::optional<FoundPressures> solve(const Unknowns& x) {
    FoundPressures found;
    found.channels = options_.max_pressure * x;
    channels_.expandInto(found.channels, chambers_);
    workspace_.reset();
    ++solves_;
    const StiffnessSolution solution = model_.solve(chambers_, Wrench::Zero(), workspace_);
    if (!solution.status.ok()) return std::nullopt;
    found.X_BT = solution.X_BT;
    found.miss = (solution.X_BT.p - point_).norm();
    found.stiffness = freeStiffnessAlong(solution.compliance, {Vector3::Zero(), direction_});
    if (!(found.stiffness > 0.0)) return std::nullopt;
    return found;
  }

  std::optional<Derivatives> derivatives(const Unknowns& x) {
    const std::optional<FoundPressures> at = solve(x);
    if (!at) return std::nullopt;
    Derivatives d{*at, Eigen::Matrix3Xd(3, size()), Eigen::VectorXd(size())};
    for (int k = 0; k < size(); ++k) {
      Unknowns up = x, down = x;
      up[k] += kStep;
      down[k] -= kStep;
      const std::optional<FoundPressures> above = solve(up), below = solve(down);
      if (!above || !below) return std::nullopt;
      d.position.col(k) = (above->X_BT.p - below->X_BT.p) / (2.0 * kStep);
      d.log_stiffness[k] = std::log(above->stiffness / below->stiffness) / (2.0 * kStep);
    }
    return d;
  }

 private:
  const StiffnessModel& model_;
  const ChannelMap& channels_;
  Vector3 point_, direction_;
  const FinderOptions& options_;
  StiffnessWorkspace workspace_;
  Pressures chambers_;
  long solves_ = 0;
};

// Levenberg-Marquardt on the distance to the point. An unknown at its bound stays there if the step would cross it.
std::optional<FoundPressures> approach(Problem& problem, Unknowns& x) {
  std::optional<Derivatives> d = problem.derivatives(x);
  double damping = 1e-3;
  for (int iteration = 0; d && iteration < 60 && d->at.miss > 1e-9; ++iteration) {
    const Vector3 residual = d->at.X_BT.p - problem.point();
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

// One run of SLSQP. Keeps the best configuration within the tolerance that it visits.
class Improver {
 public:
  Improver(Problem& problem, double sign, double tolerance) : problem_(problem), sign_(sign), tolerance_(tolerance) {}

  void run(const Unknowns& start, FoundPressures& best) {
    best_ = &best;
    const unsigned size = static_cast<unsigned>(start.size());
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(nlopt_create(NLOPT_LD_SLSQP, size),
                                                                      nlopt_destroy);
    optimiser_ = optimiser.get();
    nlopt_set_lower_bounds1(optimiser_, 0.0);
    nlopt_set_upper_bounds1(optimiser_, 1.0);
    nlopt_set_min_objective(optimiser_, objective, this);
    const double goals[3] = {1e-3, 1e-3, 1e-3};
    nlopt_add_equality_mconstraint(optimiser_, 3, constraint, this, goals);
    nlopt_set_xtol_abs1(optimiser_, 1e-7);
    nlopt_set_maxeval(optimiser_, 150);
    Unknowns x = start;
    double value = 0.0;
    nlopt_optimize(optimiser_, x.data(), &value);  // its return value does not matter: the result is in `best`
    optimiser_ = nullptr;
    // Its last configuration may be slightly off the point: correct that.
    x = x.cwiseMax(0.0).cwiseMin(1.0);
    if (x.allFinite())
      if (const auto found = approach(problem_, x)) consider(*found);
  }

 private:
  void consider(const FoundPressures& found) {
    if (found.miss <= tolerance_ && sign_ * found.stiffness > sign_ * best_->stiffness) *best_ = found;
  }

  bool update(unsigned size, const double* x) {
    const Eigen::Map<const Unknowns> wanted(x, size);
    if (last_ && last_x_ == wanted) return true;
    last_x_ = wanted;
    last_ = problem_.derivatives(last_x_);
    if (!last_) {
      nlopt_force_stop(optimiser_);
      return false;
    }
    // Only configurations exactly at the point: others within the tolerance could be stiffer because they are off.
    if (last_->at.miss <= 1e-3 * tolerance_) consider(last_->at);
    return true;
  }

  static double objective(unsigned size, const double* x, double* gradient, void* self) {
    Improver& me = *static_cast<Improver*>(self);
    if (!me.update(size, x)) return 0.0;
    if (gradient) Eigen::Map<Unknowns>(gradient, size) = -me.sign_ * me.last_->log_stiffness;
    return -me.sign_ * std::log(me.last_->at.stiffness);
  }

  // In units of the tolerance.
  static void constraint(unsigned, double* result, unsigned size, const double* x, double* gradient, void* self) {
    Improver& me = *static_cast<Improver*>(self);
    if (!me.update(size, x)) {
      std::fill_n(result, 3, 0.0);
      if (gradient) std::fill_n(gradient, 3 * size, 0.0);
      return;
    }
    const double scale = 1.0 / me.scale();
    Eigen::Map<Vector3> value(result);
    value = scale * (me.last_->at.X_BT.p - me.problem_.point());
    if (gradient) {
      using RowMajor = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
      Eigen::Map<RowMajor>(gradient, 3, size) = scale * me.last_->position;
    }
  }

  double scale() const { return 10.0 * tolerance_; }

  Problem& problem_;
  double sign_, tolerance_;
  nlopt_opt optimiser_ = nullptr;
  FoundPressures* best_ = nullptr;
  Unknowns last_x_;
  std::optional<Derivatives> last_;
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
  Problem problem(model, channels, point, direction, options);
  FinderResult result;
  std::mt19937_64 engine(options.seed);
  std::vector<Unknowns> arrived;
  for (int i = 0; i <= options.starts; ++i) {
    Unknowns x = Unknowns::Constant(problem.size(), 0.5);
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
  Improver stiffen(problem, 1.0, options.tolerance), soften(problem, -1.0, options.tolerance);
  for (const Unknowns& x : arrived) {
    stiffen.run(x, result.stiffest);
    soften.run(x, result.softest);
  }
  result.solves = problem.solves();
  return result;
}

}  // namespace live_stiffness
