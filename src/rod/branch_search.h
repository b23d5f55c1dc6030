#pragma once
// Load continuation: follows the stable equilibrium of a robot while its loads grow from zero.
//
// A robot that bends under its loads has one branch of equilibria that starts at zero load. The branch may lose its
// stability: at a bifurcation (a standing column starts to lean) or at a fold (the robot snaps through). The search detects
// this, since the tangent compliance must stay positive definite from step to step and the base moment must not jump. Then it
// goes around that point: just before it, a small lateral force at the tip is added, in the direction in which the robot
// yields; the loads grow to their full size, and the small force is removed. The result is the stable branch to which the
// robot moves when the first one becomes unstable. A symmetric column, which may lean in any direction, ends in a neutral
// equilibrium, which is not stable.

#include <optional>

#include "rod/backbone.h"

namespace live_stiffness {

struct Equilibrium {
  Vector3 base_moment = Vector3::Zero();  // N m, base axes
  Vector3 p_BT = Vector3::Zero();         // m
  Matrix6 tangent = Matrix6::Zero();      // compliance of T, base axes
  bool stable = false;
};

// What the search needs of a solver.
class EquilibriumFinder {
 public:
  virtual ~EquilibriumFinder() = default;
  // The equilibrium to which the solver converges from the guessed base moment, if it does.
  virtual std::optional<Equilibrium> solve(const DeadLoads& loads, const Vector3& base_moment) = 0;
  // Moment as bending of the most compliant segment over its length, rad.
  virtual double bendingOf(const Vector3& moment) const = 0;
  // True once the bound on iterations is reached.
  virtual bool exhausted() const = 0;
};

enum class BranchEnd {
  kLoading,       // stable all the way from zero load
  kBuckled,       // the branch from zero load loses its stability or turns too sharply; on the stable one that follows
  kUnstable,      // it loses its stability, and no stable one was found
  kNotConverged,  // the bound on iterations was reached, or steps became too small
};

class BranchSearch {
 public:
  // length: of the robot, m.
  BranchSearch(EquilibriumFinder& finder, double length) : finder_(finder), length_(length) {}

  // From zero load to `loads`. For kLoading and kBuckled the last solve() of the finder is the result.
  BranchEnd run(const DeadLoads& loads);

  // The same for small loads, in this number of equal steps (at least one). Up to the first step there must be only one
  // equilibrium. unloaded: base moment and tip at zero load. Reads no tangents. True: kLoading; false: call run().
  bool runCoarse(const DeadLoads& loads, const Equilibrium& unloaded, int steps);

  // Share of the loads up to which the branch from zero load was seen to be stable.
  double stableShare() const { return stable_share_; }

 private:
  bool follow(const DeadLoads& target, double least_advance);
  bool jumped(const Equilibrium& at, const Equilibrium& expected) const;
  bool goAround(const DeadLoads& target, const Vector3& push, BranchEnd& end);

  EquilibriumFinder& finder_;
  double length_;
  DeadLoads loads_;         // reached so far
  Equilibrium at_;          // at loads_
  Vector3 moved_ = Vector3::Zero();  // of the tip in the last step, m
  double share_ = 0.0;      // of the way from the start to the target of follow()
  bool lost_stability_ = false;
  double stable_share_ = 0.0;
};

}  // namespace live_stiffness
