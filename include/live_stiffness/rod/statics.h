#pragma once
// Boundary value problem of a scene under dead loads (weight, tip wrench), by shooting on the base moment.
//
// For dead loads the force n(s) is known in advance (weights beyond s plus the tip force), so only the base moment m0
// is unknown: three unknowns for any number of segments and links. The residual is the moment left over at T.

#include "live_stiffness/rod/branch_search.h"
#include "live_stiffness/rod/shooting.h"

namespace live_stiffness {

struct StaticsReport {
  bool converged = false;
  bool stable = false;         // the tangent compliance is positive definite and the robot stable inside; false: buckled
                               // over, at the brink, or neutral (a symmetric column that may lean in any direction)
  bool buckled = false;        // the branch that starts at zero load was seen to lose its stability before the full
                               // loads; the result is on the stable one that it gives way to
  double stable_share = 1.0;   // of the loads, up to which that branch was seen to be stable
  int iterations = 0;          // passes over the chain, all attempts together; at most 2 kMaxIterations
  double residual = 0.0;       // of the tip moment, as bending of the softest segment over its length, rad
  double truncation = 0.0;     // estimated relative error of discretisation
};

class StaticsSolver {
 public:
  static constexpr int kMaxIterations = 600;

  // The scene must outlive the solver. accuracy: relative, for the choice of the number of elements.
  StaticsSolver(const Scene& scene, double accuracy);

  // Solves from backbone.rest. Starts from the last solution unless reset() was called, else from the unloaded shape.
  // When that finds no stable equilibrium, or starts cold under loads that allow several, it is found by a branch search
  // along the loads from zero. On success backbone holds the shape and the tangent can be read.
  //
  // A warm start stays on the branch of the last solution while that is stable, as the robot does, even where a cold
  // start would find another one: which of several stable shapes a robot is in depends on its past. To tell would take
  // a search along the loads, many times the cost of the solve; reset() gives the cold answer.
  StaticsReport solve(const DeadLoads& loads, Backbone& backbone);

  // Compliance of T under a dead wrench at T (base axes), by the derivative of the loaded equilibrium: tangent, 6x6.
  const Matrix6& tangentCompliance() const { return tangent_; }
  // Total moment at the base, N m, base axes.
  const Vector3& baseMoment() const { return base_moment_; }

  void reset() { warm_ = false; }

 private:
  class Finder;  // for the branch search
  bool findEquilibrium(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool findAlongLoads(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool findTangent(const DeadLoads& loads, const Backbone& backbone);
  bool mayBuckle(const DeadLoads& loads, const Backbone& backbone) const;
  bool isStable(const DeadLoads& loads, const Backbone& backbone, const StaticsReport& report) const;
  bool march(const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone, Vector3& residual);
  bool newton(const DeadLoads& loads, Backbone& backbone, int max_iterations, StaticsReport& report);
  bool resizeElements(Backbone& backbone);
  void placeFresh(const DeadLoads& loads, Backbone& backbone);
  void chooseElements(const DeadLoads& loads, Backbone& backbone) const;
  bool refine(Backbone& backbone, StaticsReport& report) const;
  double bendingOf(const Vector3& moment, const Backbone& backbone) const;

  const Scene& scene_;
  double accuracy_;
  Vector3 base_moment_ = Vector3::Zero();
  Matrix3 residual_inverse_ = Matrix3::Zero();  // of d residual / d base moment
  Matrix6 tangent_ = Matrix6::Zero();
  bool warm_ = false;
  bool nodes_hold_guess_ = false;
};

}  // namespace live_stiffness
