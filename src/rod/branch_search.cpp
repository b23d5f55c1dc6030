#include "rod/branch_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace live_stiffness {
namespace {

constexpr int kMemory = 5;              // number of steps from which the next one is extrapolated
constexpr double kFirstAdvance = 0.25;  // share of the way to the target
constexpr double kLeastAdvance = 1e-3;  // from zero load; when steps become smaller, go around
constexpr double kLeastAdvanceAround = 1e-5;
constexpr double kMostBending = 0.5;    // rad, largest difference of a step from its extrapolation
constexpr double kMostMiss = 0.4;       // the same for the tip, divided by the length
constexpr double kMotionAimed = 0.35;   // motion of the tip in a step, divided by the length, that sets the size of the next
constexpr double kFoldGrowth = 5.0;
constexpr double kPush = 0.05;          // deflection of the unloaded robot by the push, divided by its length

DeadLoads between(const DeadLoads& a, const DeadLoads& b, double share) {
  return {(1.0 - share) * a.gravity + share * b.gravity, (1.0 - share) * a.tip + share * b.tip};
}

DeadLoads withForce(DeadLoads loads, const Vector3& force) {
  linear(loads.tip) += force;
  return loads;
}

// Largest translation that a unit force at the tip can cause (m/N), and the direction of that force.
struct MostCompliantDirection {
  Vector3 direction;
  double compliance;

  explicit MostCompliantDirection(const Matrix3& C) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(0.5 * (C + C.transpose()));
    direction = eigen.eigenvectors().col(2);
    compliance = eigen.eigenvalues()[2];
  }
};

// Direction in which the robot yields: the last motion of the tip, weighted by the compliance. For a straight column, which
// has not moved laterally, the most compliant direction.
Vector3 directionOfCollapse(const Matrix3& C, const Vector3& moved) {
  const MostCompliantDirection most_compliant(C);
  const Vector3 yielding = C * (C * moved);
  if (yielding.norm() > 1e-9 * most_compliant.compliance * most_compliant.compliance * moved.norm()) return yielding.normalized();
  return most_compliant.direction;
}

// The last steps towards a target, from which the next one is extrapolated.
class Path {
 public:
  Path(double share, const Equilibrium& at) {
    moments_.fill(at.base_moment);
    tips_.fill(at.p_BT);
    add(share, at);
  }

  void add(double share, const Equilibrium& at) {
    for (int i = kMemory - 1; i > 0; --i) {
      reached_[i] = reached_[i - 1];
      moments_[i] = moments_[i - 1];
      tips_[i] = tips_[i - 1];
    }
    reached_[0] = share;
    moments_[0] = at.base_moment;
    tips_[0] = at.p_BT;
    known_ = std::min(known_ + 1, kMemory);
  }
  void keep(int count) { known_ = std::min(known_, count); }

  // Extrapolated end of the next step.
  Equilibrium at(double share) const {
    Equilibrium expected;
    for (int i = 0; i < known_; ++i) {
      double weight = 1.0;  // of Lagrange's polynomial
      for (int j = 0; j < known_; ++j)
        if (j != i) weight *= (share - reached_[j]) / (reached_[i] - reached_[j]);
      expected.base_moment += weight * moments_[i];
      expected.p_BT += weight * tips_[i];
    }
    return expected;
  }

 private:
  std::array<double, kMemory> reached_{};  // shares of the way, newest first
  std::array<Vector3, kMemory> moments_, tips_;
  int known_ = 0;
};

}  // namespace

bool BranchSearch::jumped(const Equilibrium& at, const Equilibrium& expected) const {
  return finder_.bendingOf(at.base_moment - expected.base_moment) > kMostBending ||
         (at.p_BT - expected.p_BT).norm() > kMostMiss * length_;
}

// From the loads reached so far straight to the target, in steps of adaptive size. The base moment of the next step is
// extrapolated from the last ones; to scale it with the load would not be accurate enough, since errors grow exponentially
// along a long hanging chain. A step that ends far from its extrapolation may have jumped to another branch.
bool BranchSearch::follow(const DeadLoads& target, double least_advance) {
  const DeadLoads start = loads_;
  Path path(0.0, at_);
  int rejected = 0;
  double advance = kFirstAdvance;
  share_ = 0.0;
  lost_stability_ = false;
  while (share_ < 1.0) {
    if (advance < least_advance || finder_.exhausted()) return false;
    const double trial = std::min(1.0, share_ + advance);
    const Equilibrium expected = path.at(trial);
    const DeadLoads loads = between(start, target, trial);
    const std::optional<Equilibrium> next = finder_.solve(loads, expected.base_moment);
    if (!next || !next->stable || jumped(*next, expected)) {
      lost_stability_ = next.has_value();
      advance *= 0.4;
      if (next && ++rejected > 2) path.keep(2);  // the branch is less smooth than the extrapolation assumes
      continue;
    }
    share_ = trial;
    path.add(trial, *next);
    rejected = 0;
    moved_ = next->p_BT - at_.p_BT;
    at_ = *next;
    loads_ = loads;
    advance *= std::clamp(kMotionAimed * length_ / moved_.norm(), 0.6, 1.6);
  }
  return true;
}

bool BranchSearch::runCoarse(const DeadLoads& loads, const Equilibrium& unloaded, int steps) {
  Path path(0.0, unloaded);
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const Equilibrium expected = path.at(share);
    const std::optional<Equilibrium> next = finder_.solve(between(DeadLoads(), loads, share), expected.base_moment);
    if (!next || !next->stable || (i > 1 && jumped(*next, expected))) return false;
    path.add(share, *next);
  }
  return true;
}

// Goes around with this push. True if the loads were reached; then `end` is the result of removing the push.
bool BranchSearch::goAround(const DeadLoads& target, const Vector3& push, BranchEnd& end) {
  if (!follow(withForce(loads_, push), kLeastAdvanceAround) || !follow(withForce(target, push), kLeastAdvanceAround))
    return false;
  end = follow(target, 0.1 * kLeastAdvance) ? BranchEnd::kBuckled : BranchEnd::kUnstable;
  return true;
}

BranchEnd BranchSearch::run(const DeadLoads& loads) {
  const std::optional<Equilibrium> unloaded = finder_.solve(DeadLoads(), Vector3::Zero());
  if (!unloaded) return BranchEnd::kNotConverged;
  loads_ = DeadLoads();
  at_ = *unloaded;
  const bool followed = follow(loads, kLeastAdvance);
  stable_share_ = share_;
  if (followed) return BranchEnd::kLoading;
  // Just beyond a fold there is no equilibrium nearby. But before it the compliance grows, as 1 / sqrt(distance to the fold).
  const double compliance = MostCompliantDirection(at_.tangent.topLeftCorner<3, 3>()).compliance;
  const double unloaded_compliance = MostCompliantDirection(unloaded->tangent.topLeftCorner<3, 3>()).compliance;
  const bool at_fold = compliance > kFoldGrowth * unloaded_compliance;
  if (finder_.exhausted() || !(lost_stability_ || at_fold)) return BranchEnd::kNotConverged;

  const DeadLoads last_stable = loads_;
  const Equilibrium before = at_;
  const Vector3 push = kPush * length_ / unloaded_compliance * directionOfCollapse(before.tangent.topLeftCorner<3, 3>(), moved_);
  BranchEnd end = BranchEnd::kUnstable;
  for (double sign : {1.0, -1.0}) {
    loads_ = last_stable;
    at_ = before;
    if (goAround(loads, sign * push, end)) return end;  // kUnstable: a neutral equilibrium
  }
  return end;
}

}  // namespace live_stiffness
