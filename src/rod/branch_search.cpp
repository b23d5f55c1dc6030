#include "live_stiffness/rod/branch_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace live_stiffness {
namespace {

constexpr int kMemory = 5;              // steps that the next one is extrapolated from
constexpr double kFirstAdvance = 0.25;  // share of a leg
constexpr double kLeastAdvance = 1e-3;  // from zero load on: then it is time to go around
constexpr double kLeastAdvanceAround = 1e-5;
constexpr double kMostBending = 0.5;    // rad, by which a step may miss what the last ones let expect
constexpr double kMostMiss = 0.4;       // the same of the tip, over the length
constexpr double kMotionAimed = 0.35;   // of the tip in a step, over the length; the next one is as long as that lets expect
constexpr double kFoldGrowth = 5.0;
constexpr double kPush = 0.05;          // deflection by the push, were the robot unloaded, over its length

DeadLoads between(const DeadLoads& a, const DeadLoads& b, double share) {
  return {(1.0 - share) * a.gravity + share * b.gravity, (1.0 - share) * a.tip + share * b.tip};
}

DeadLoads withForce(DeadLoads loads, const Vector3& force) {
  linear(loads.tip) += force;
  return loads;
}

// Largest translation that a unit force at the tip can cause (m/N), and the force's direction.
struct SoftestDirection {
  Vector3 direction;
  double compliance;

  explicit SoftestDirection(const Matrix3& C) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(0.5 * (C + C.transpose()));
    direction = eigen.eigenvectors().col(2);
    compliance = eigen.eigenvalues()[2];
  }
};

// Where the robot is giving way: the tip's last motion as far as it is along soft directions. Of a straight column,
// which has not moved sideways, any soft direction.
Vector3 directionOfCollapse(const Matrix3& C, const Vector3& moved) {
  const SoftestDirection softest(C);
  const Vector3 softly = C * (C * moved);
  if (softly.norm() > 1e-9 * softest.compliance * softest.compliance * moved.norm()) return softly.normalized();
  return softest.direction;
}

}  // namespace

// One straight leg from the loads reached so far, in steps of adaptive size. The base moment of the next step is
// extrapolated from the last ones: on a long hanging chain a shot strays exponentially, so that a moment scaled with
// the load would not do. A step that ends elsewhere than that lets expect may have jumped to another branch.
bool BranchSearch::follow(const DeadLoads& target, double least_advance) {
  const DeadLoads start = loads_;
  std::array<double, kMemory> reached{};  // shares, newest first
  std::array<Vector3, kMemory> moments, tips;
  moments.fill(at_.base_moment);
  tips.fill(at_.p_BT);
  int known = 1, rejected = 0;
  double advance = kFirstAdvance;
  share_ = 0.0;
  lost_stability_ = false;
  while (share_ < 1.0) {
    if (advance < least_advance || finder_.exhausted()) return false;
    const double trial = std::min(1.0, share_ + advance);
    Vector3 guess = Vector3::Zero(), expected_tip = Vector3::Zero();
    for (int i = 0; i < known; ++i) {
      double weight = 1.0;  // Lagrange's
      for (int j = 0; j < known; ++j)
        if (j != i) weight *= (trial - reached[j]) / (reached[i] - reached[j]);
      guess += weight * moments[i];
      expected_tip += weight * tips[i];
    }
    const DeadLoads loads = between(start, target, trial);
    const std::optional<Equilibrium> next = finder_.settle(loads, guess);
    const bool jumped = next && (finder_.bendingOf(next->base_moment - guess) > kMostBending ||
                                 (next->p_BT - expected_tip).norm() > kMostMiss * length_);
    if (!next || !next->stable || jumped) {
      lost_stability_ = next.has_value();
      advance *= 0.4;
      if (next && ++rejected > 2) known = std::min(known, 2);  // the path is not as smooth as it looked
      continue;
    }
    for (int i = kMemory - 1; i > 0; --i) {
      reached[i] = reached[i - 1];
      moments[i] = moments[i - 1];
      tips[i] = tips[i - 1];
    }
    share_ = reached[0] = trial;
    moments[0] = next->base_moment;
    tips[0] = next->p_BT;
    known = std::min(known + 1, kMemory);
    rejected = 0;
    moved_ = next->p_BT - at_.p_BT;
    at_ = *next;
    loads_ = loads;
    advance *= std::clamp(kMotionAimed * length_ / moved_.norm(), 0.6, 1.6);
  }
  return true;
}

// True if the loads were reached beside the first branch; then `end` says what taking the push away led to.
bool BranchSearch::goAround(const DeadLoads& target, const Vector3& push, BranchEnd& end) {
  if (!follow(withForce(loads_, push), kLeastAdvanceAround) || !follow(withForce(target, push), kLeastAdvanceAround))
    return false;
  end = follow(target, 0.1 * kLeastAdvance) ? BranchEnd::kBuckled : BranchEnd::kUnstable;
  return true;
}

BranchEnd BranchSearch::run(const DeadLoads& loads) {
  const std::optional<Equilibrium> unloaded = finder_.settle(DeadLoads(), Vector3::Zero());
  if (!unloaded) return BranchEnd::kNotConverged;
  loads_ = DeadLoads();
  at_ = *unloaded;
  const bool followed = follow(loads, kLeastAdvance);
  stable_share_ = share_;
  if (followed) return BranchEnd::kLoading;
  // At a fold there is nothing beyond to settle to; but the compliance has grown, as the inverse root of what is left.
  const double compliance = SoftestDirection(at_.tangent.topLeftCorner<3, 3>()).compliance;
  const double unloaded_compliance = SoftestDirection(unloaded->tangent.topLeftCorner<3, 3>()).compliance;
  const bool at_fold = compliance > kFoldGrowth * unloaded_compliance;
  if (finder_.exhausted() || !(lost_stability_ || at_fold)) return BranchEnd::kNotConverged;

  const DeadLoads last_stable = loads_;
  const Equilibrium before = at_;
  const Vector3 push = kPush * length_ / unloaded_compliance * directionOfCollapse(before.tangent.topLeftCorner<3, 3>(), moved_);
  BranchEnd end = BranchEnd::kUnstable;
  for (double sign : {1.0, -1.0}) {
    loads_ = last_stable;
    at_ = before;
    if (goAround(loads, sign * push, end)) return end;  // when the push cannot go, a neutral equilibrium is at its end
  }
  return end;
}

}  // namespace live_stiffness
