#pragma once
// Boundary value problem of a scene under dead loads (weight, tip wrench), by shooting on the base moment.
//
// For dead loads the force n(s) is known in advance (weights beyond s plus the tip force), so only the base moment m0
// is unknown: three unknowns for any number of segments and links. The residual is the moment left over at T.

#include "rod/branch_search.h"
#include "rod/discretisation.h"
#include "rod/shooting.h"

namespace live_stiffness {

struct StaticsReport {
  bool converged = false;
  bool stable = false;         // the tangent compliance is positive definite and the robot stable inside; false: buckled
                               // over, at the brink, or neutral (a symmetric column that may lean in any direction)
  bool buckled = false;        // the branch that starts at zero load was seen to lose its stability before the full
                               // loads; the result is on the stable one that it gives way to
  double stable_share = 1.0;   // of the loads, up to which that branch was seen to be stable
  int iterations = 0;          // sweeps, and shots or series of sweeps of a search along the loads, all attempts
                               // together; at most 2 kMaxIterations
  double residual = 0.0;       // of the tip moment, as bending of the softest segment over its length, rad
  double truncation = 0.0;     // estimated relative error of discretisation
  double iteration = 0.0;      // estimated relative error of shape and columns, left by their last passes
  double rounding = 0.0;       // estimated relative error of rounding; grows on long taut chains
  double amplification = 1.0;  // of all of them in the tangent: how much softer it is than unloaded; grows towards buckling

  double relativeError() const { return truncation + residual + iteration + rounding; }
};

class StaticsSolver {
 public:
  static constexpr int kMaxIterations = 600;

  // accuracy: relative; decides stages, number of elements and when passes stop. stages: 0, or those of every element.
  StaticsSolver(const Scene& scene, double accuracy, int stages = 0);
  StaticsSolver(const StaticsSolver&) = delete;  // its parts refer to one another

  // Solves from backbone.rest. Starts from the last solution unless reset() was called, else from the unloaded shape:
  // quick sweeps, which mend shape and base moment together; if they do not converge, damped Newton steps on converged
  // shots. When that finds no stable equilibrium, or starts cold under loads that allow several, it is found by a
  // branch search along the loads from zero. On success backbone holds the shape and the tangent can be read.
  //
  // A warm start stays on the branch of the last solution while that is stable, as the robot does, even where a cold
  // start would find another one: which of several stable shapes a robot is in depends on its past. To tell would take
  // a search along the loads, many times the cost of the solve; reset() gives the cold answer.
  StaticsReport solve(const DeadLoads& loads, Backbone& backbone);

  // Makes the backbone ready for placeUnloaded() of compliance/material_compliance.h, and forgets the last solution.
  void prepareUnloaded(Backbone& backbone);

  const Chain& chain() const { return chain_; }

  // Compliance of T under a dead wrench at T (base axes), by the derivative of the loaded equilibrium: tangent, 6x6.
  const Matrix6& tangentCompliance() const { return tangent_; }
  // Total moment at the base, N m, base axes.
  const Vector3& baseMoment() const { return base_moment_; }

  void reset();

 private:
  static constexpr int kMaxSweeps = 40;
  static constexpr double kSlowestRate = 0.2;  // at which sweeps may be counted on to converge, at worst

  class Finder;  // for the branch search
  enum class Known {  // of a solution nearby
    kNothing,
    kInverse,  // of the residual's derivative
    kColumns,  // and the elements hold its shape and columns
  };
  bool quick(const DeadLoads& loads, Known known, int max_sweeps, Backbone& backbone, StaticsReport& report);
  void goOn(const DeadLoads& loads, Backbone& backbone);
  bool findEquilibrium(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool findAlongLoads(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  void polish(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool findTangent(const DeadLoads& loads, Backbone& backbone, StaticsReport& report, ColumnSet set = ColumnSet::kAll);
  bool mayBuckle(const DeadLoads& loads, const Backbone& backbone) const;
  bool isStable(const DeadLoads& loads, const Backbone& backbone, const StaticsReport& report,
                ColumnSet set = ColumnSet::kAll) const;
  bool updateInverse(const DeadLoads& loads, double goal, Backbone& backbone);
  bool march(const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone, Vector3& residual);
  bool newton(const DeadLoads& loads, Backbone& backbone, int max_iterations, StaticsReport& report);
  void forgetGuesses(const DeadLoads& loads, Backbone& backbone);
  void placeFresh(const DeadLoads& loads, Backbone& backbone);
  Vector3 momentOfUnloaded(const DeadLoads& loads, const Backbone& backbone) const;
  double bendingOf(const Vector3& moment) const { return softness_ * moment.norm(); }

  Chain chain_;
  double length_, accuracy_;
  Discretisation discretisation_;
  Vector3 base_moment_ = Vector3::Zero(), moment_before_ = Vector3::Zero();  // of this solution and the last
  Matrix3 residual_inverse_ = Matrix3::Zero();  // of d residual / d base moment
  Matrix6 tangent_ = Matrix6::Zero();
  double softness_ = 0.0;      // L c_bt of the softest segment, rad / (N m)
  double stiffest_ = 0.0;      // rotation of the tip by a unit moment about its stiffest axis, unloaded, rad / (N m)
  double amplification_ = 1.0; // see StaticsReport, of the last solve
  History history_ = History::kNone;  // what the last warm solve kept
  long solutions_ = 0;         // so far, one after the other on the same elements
  double rate_;                // at which the last sweeps converged
  bool warm_ = false;          // base moment and inverse are those of a solution
  bool has_columns_ = false;   // the elements hold columns of a shape nearby
  bool nodes_hold_guess_ = false;
};

}  // namespace live_stiffness
