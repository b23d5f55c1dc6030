#pragma once
// Boundary value problem of a scene under dead loads (weight, tip wrench), by shooting on the base moment.
//
// For dead loads the force n(s) is known in advance (weights beyond s plus the tip force), so only the base moment m0
// is unknown: three unknowns for any number of segments and links. The residual is the moment left over at T.

#include "live_stiffness/rod/discretisation.h"
#include "live_stiffness/rod/shooting.h"

namespace live_stiffness {

struct StaticsReport {
  bool converged = false;
  bool stable = false;         // the tangent compliance is positive definite; false: buckled over, or at the brink
  int iterations = 0;          // passes over the chain, all attempts together; at most 2 kMaxIterations
  double residual = 0.0;       // of the tip moment, as bending of the softest segment over its length, rad
  double truncation = 0.0;     // estimated relative error of discretisation
  double iteration = 0.0;      // relative change of shape and columns in their last passes
};

class StaticsSolver {
 public:
  static constexpr int kMaxIterations = 400;

  // accuracy: relative; decides stages, number of elements and when passes stop. stages: 0, or those of every element.
  StaticsSolver(const Scene& scene, double accuracy, int stages = 0);
  StaticsSolver(const StaticsSolver&) = delete;  // its parts refer to one another

  // Solves from backbone.rest. Starts from the last solution unless reset() was called: quick sweeps first, which mend
  // shape and base moment together; if they do not converge, damped Newton steps on converged shots from the unloaded
  // shape, then load continuation. Of an unstable equilibrium it tries once more along the loads from zero, and keeps
  // the stable one if that finds it. On success backbone holds the shape and the tangent can be read.
  StaticsReport solve(const DeadLoads& loads, Backbone& backbone);

  // Shape without loads, in closed form.
  void placeUnloaded(Backbone& backbone);

  // Compliance of T under a dead wrench at T (base axes), by the derivative of the loaded equilibrium: tangent, 6x6.
  const Matrix6& tangentCompliance() const { return tangent_; }
  // Total moment at the base, N m, base axes.
  const Vector3& baseMoment() const { return base_moment_; }

  void reset() { warm_ = has_columns_ = false; }

 private:
  bool quick(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool findEquilibrium(const DeadLoads& loads, bool along_loads, Backbone& backbone, StaticsReport& report);
  bool findTangent(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool isStable() const;
  bool updateInverse(const DeadLoads& loads, double goal, Backbone& backbone);
  bool march(const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone, Vector3& residual);
  bool newton(const DeadLoads& loads, Backbone& backbone, int max_iterations, StaticsReport& report);
  bool continuation(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  void resetGuesses(const DeadLoads& loads, Backbone& backbone);
  void placeFresh(const DeadLoads& loads, Backbone& backbone);
  double bendingOf(const Vector3& moment) const { return softness_ * moment.norm(); }

  Chain chain_;
  double accuracy_;
  Discretisation discretisation_;
  Vector3 base_moment_ = Vector3::Zero();
  Matrix3 residual_inverse_ = Matrix3::Zero();  // of d residual / d base moment
  Matrix6 tangent_ = Matrix6::Zero();
  double softness_ = 0.0;      // L c_bt of the softest segment, rad / (N m)
  bool warm_ = false;          // shape, base moment and inverse are those of a solution
  bool has_columns_ = false;   // the elements hold columns of a shape nearby
};

}  // namespace live_stiffness
