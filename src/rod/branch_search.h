#pragma once
// Follows the equilibrium of a robot as its loads grow from zero, and keeps to stable ones.
//
// A robot that bends under its loads has one branch of equilibria that starts at zero load. It may lose its stability
// on the way: at a bifurcation (a standing column starts to lean) or at a fold (it snaps). The search notices, because
// the tangent compliance must stay positive definite from step to step and the base moment must not jump, and then goes
// around: a small sideways force at the tip, the way it is giving, is added just before that load, the loads grow
// to their full size beside it, and it is taken away again. What is left is the stable branch that the first one gives
// way to. A symmetric column, which may lean in any direction, ends in a neutral equilibrium; that is not stable.

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
  // The equilibrium that a few steps from the guessed base moment lead to, if they do.
  virtual std::optional<Equilibrium> settle(const DeadLoads& loads, const Vector3& base_moment) = 0;
  // Moment as bending of the softest segment over its length, rad.
  virtual double bendingOf(const Vector3& moment) const = 0;
  // True once the bound on iterations is reached.
  virtual bool exhausted() const = 0;
};

enum class BranchEnd {
  kLoading,       // stable all the way from zero load
  kBuckled,       // that branch loses its stability, or turns too sharply to follow; on the one that it gives way to
  kUnstable,      // it loses its stability, and no stable one was found
  kNotConverged,  // the bound on iterations, or steps grew too small
};

class BranchSearch {
 public:
  // length: of the robot, m.
  BranchSearch(EquilibriumFinder& finder, double length) : finder_(finder), length_(length) {}

  // From zero load to `loads`. On kLoading and kBuckled the finder's last settle() was the result.
  BranchEnd run(const DeadLoads& loads);

  // The same in so many equal steps (at least one), for loads that are little; up to the first of them there must be one
  // equilibrium only. unloaded: base moment and tip at zero load. Reads no tangents. True: kLoading; false: run() must tell.
  bool runBriskly(const DeadLoads& loads, const Equilibrium& unloaded, int steps);

  // Share of the loads up to which the branch from zero load was seen to be stable.
  double stableShare() const { return stable_share_; }

 private:
  bool follow(const DeadLoads& target, double least_advance);
  bool jumped(const Equilibrium& at, const Equilibrium& expected) const;
  bool goAround(const DeadLoads& target, const Vector3& push, BranchEnd& end);

  EquilibriumFinder& finder_;
  double length_;
  DeadLoads loads_;         // reached so far
  Equilibrium at_;          // there
  Vector3 moved_ = Vector3::Zero();  // of the tip in the last step, m
  double share_ = 0.0;      // of the last leg
  bool lost_stability_ = false;
  double stable_share_ = 0.0;
};

}  // namespace live_stiffness
