#pragma once
// Boundary value problem of a scene under dead loads (weight, tip wrench), by shooting on the base moment.
//
// For dead loads the force n(s) is known in advance (weights beyond s plus the tip force), so only the base moment m0
// is unknown: three unknowns for any number of segments and links. The residual is the moment at T that no load explains.

#include "rod/branch_search.h"
#include "rod/discretisation.h"
#include "rod/shooting.h"

namespace live_stiffness {

struct StaticsReport {
  bool converged = false;
  bool stable = false;         // the tangent compliance is positive definite and there is no conjugate point; false:
                               // unstable, or neutral (a symmetric column that may lean in any direction)
  bool buckled = false;        // the branch that starts at zero load loses its stability before the full loads; the
                               // result is on the stable branch that follows
  double stable_share = 1.0;   // share of the loads up to which that branch is stable
  int iterations = 0;          // iterations over the chain; of load continuation: shots, or series of iterations; all
                               // attempts together, at most 2 kMaxIterations
  double residual = 0.0;       // of the tip moment, as bending of the most compliant segment over its length, rad
  double truncation = 0.0;     // estimated relative error of discretisation
  double iteration = 0.0;      // estimated relative error of shape and sensitivities after their last iterations
  double rounding = 0.0;       // estimated relative error of rounding; grows on long chains under tension
  double buckling_factor = 1.0;  // buckling factor: compliance of the tip divided by that without loads; multiplies the errors

  double relativeError() const { return truncation + residual + iteration + rounding; }
};

class StaticsSolver {
 public:
  static constexpr int kMaxIterations = 600;

  // accuracy: relative; decides stages, number of elements and when iterations stop. stages: of every element, or 0.
  StaticsSolver(const Scene& scene, double accuracy, int stages = 0);
  StaticsSolver(const StaticsSolver&) = delete;  // its parts refer to one another

  // Solves from backbone.rest. Starts from the last solution, or after reset() from the unloaded shape. First quasi-Newton
  // iterations, which correct shape and base moment together; if they do not converge, damped Newton steps with converged
  // shooting. If this finds no stable equilibrium, or if a cold start has loads that allow several, load continuation from
  // zero (branch_search.h). On success the backbone holds the shape, and the tangent can be read.
  //
  // A warm start stays on the branch of the last solution while that is stable, as the robot does, even where a cold
  // start would find another one: which of several stable shapes a robot has depends on its past. After reset() the result
  // is that of a cold start.
  StaticsReport solve(const DeadLoads& loads, Backbone& backbone);

  // Makes the backbone ready for solveUnloaded() of compliance/material_compliance.h, and forgets the last solution.
  void prepareUnloaded(Backbone& backbone);

  const Chain& chain() const { return chain_; }

  // Compliance of T under a dead wrench at T (base axes), by the derivative of the loaded equilibrium: tangent, 6x6.
  const Matrix6& tangentCompliance() const { return tangent_; }
  // Total moment at the base, N m, base axes.
  const Vector3& baseMoment() const { return base_moment_; }

  void reset();

 private:
  static constexpr int kMaxSweeps = 40;
  static constexpr double kSlowestRate = 0.2;  // largest convergence rate that the stopping rule assumes

  class Finder;  // for the branch search
  enum class Known {  // what is known of a solution nearby
    kNone,
    kInverse,  // inverse of the residual's derivative
    kSensitivities,  // the same, and the elements hold its shape and sensitivities
  };
  bool chordIteration(const DeadLoads& loads, Known known, int max_sweeps, Backbone& backbone, StaticsReport& report);
  void extrapolateGuess(const DeadLoads& loads, Backbone& backbone);
  bool findEquilibrium(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool findAlongLoads(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  void refineSolution(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool findTangent(const DeadLoads& loads, Backbone& backbone, StaticsReport& report, SensitivitySet set = SensitivitySet::kAll);
  bool mayBuckle(const DeadLoads& loads, const Backbone& backbone) const;
  bool isStable(const DeadLoads& loads, const Backbone& backbone, const StaticsReport& report,
                SensitivitySet set = SensitivitySet::kAll) const;
  bool updateInverse(const DeadLoads& loads, double goal, Backbone& backbone);
  bool integrateChain(const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone, Vector3& residual);
  bool newton(const DeadLoads& loads, Backbone& backbone, int max_iterations, StaticsReport& report);
  void forgetGuesses(const DeadLoads& loads, Backbone& backbone);
  void placeFresh(const DeadLoads& loads, Backbone& backbone);
  Vector3 momentOfUnloaded(const DeadLoads& loads, const Backbone& backbone) const;
  double bendingOf(const Vector3& moment) const { return bending_compliance_ * moment.norm(); }

  Chain chain_;
  double length_, accuracy_;
  Discretisation discretisation_;
  Vector3 base_moment_ = Vector3::Zero(), moment_before_ = Vector3::Zero();  // of this solution and the last
  Matrix3 residual_inverse_ = Matrix3::Zero();  // of d residual / d base moment
  Matrix6 tangent_ = Matrix6::Zero();
  double bending_compliance_ = 0.0;      // L c_bt of the most compliant segment, rad / (N m)
  double stiffest_ = 0.0;      // rotation of the tip by a unit moment about its stiffest axis, unloaded, rad / (N m)
  double buckling_factor_ = 1.0; // see StaticsReport, of the last solve
  History history_ = History::kNone;  // what the last warm solve kept
  long solutions_ = 0;         // number of consecutive solutions on the same elements
  double rate_;                // convergence rate of the last iterations
  bool warm_ = false;          // base moment and inverse are those of a solution
  bool has_sensitivities_ = false;   // the elements hold sensitivities of a shape nearby
  bool nodes_hold_guess_ = false;
};

}  // namespace live_stiffness
