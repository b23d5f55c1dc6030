#pragma once
// Boundary value problem of a scene under dead loads (weight, tip wrench), by multiple shooting: docs/derivation.md, section 4.
//
// Unknown are orientation and moment at the start of every element. For dead loads the force n(s) is known in advance (weights
// beyond s plus the tip force). One Newton step is a Riccati sweep over the joints, so its cost is linear in their number, and
// nothing grows along the chain.

#include "rod/discretisation.h"
#include "rod/energy_descent.h"
#include "rod/shooting.h"

namespace live_stiffness {

struct StaticsReport {
  bool converged = false;      // a stable equilibrium is found, or there is none; false: it is not known
  bool stable = false;         // the second variation of the energy is positive definite; false: unstable, or neutral (a
                               // symmetric column that may lean in any direction)
  bool neutral = false;        // no digit of the tip's compliance is left, see isNeutral() in stability.h
  double stable_share = 1.0;   // if not stable: share of the loads up to which there is a stable equilibrium nearby
  int iterations = 0;          // over the chain, all attempts together, at most kMaxIterations; without those of stable_share
  double residual = 0.0;       // of the moments, as bending of the most compliant segment over its length, rad
  double truncation = 0.0;     // estimated relative error of discretisation
  double iteration = 0.0;      // estimated relative error of shape and sensitivities after their last iterations
  double rounding = 0.0;       // estimated relative error of rounding
  double buckling_factor = 1.0;  // compliance of the tip divided by that without loads; multiplies the errors

  double relativeError() const { return truncation + residual + iteration + rounding; }
};

class StaticsSolver {
 public:
  static constexpr int kMaxIterations = 400;

  // accuracy: relative; decides stages, number of elements and when iterations stop. stages: of every element, or 0.
  StaticsSolver(const Scene& scene, double accuracy, int stages = 0);
  StaticsSolver(const StaticsSolver&) = delete;  // its parts refer to one another

  // Solves from backbone.rest. On success the backbone holds the shape, and the tangent can be read. Never allocates.
  //
  // A cold start (the first one, or after reset()) begins with the shape without loads. Where the loads are small enough,
  // Newton's method goes from there, and what it finds is taken if it is stable; else the robot first moves downhill in energy
  // while its loads grow, and the result is the stable equilibrium in whose valley that ends. A warm start begins with the last
  // solution and stays on its branch while that is stable, as the robot does, even where a cold start would find another one:
  // which of several stable shapes a robot has depends on its past.
  StaticsReport solve(const DeadLoads& loads, Backbone& backbone);

  // Makes the backbone ready for solveUnloaded() of compliance/material_compliance.h, and forgets the last solution.
  void prepareUnloaded(Backbone& backbone);

  const Chain& chain() const { return chain_; }

  // Compliance of T under a dead wrench at T (base axes), by the derivative of the loaded equilibrium: tangent, 6x6.
  const Matrix6& tangentCompliance() const { return tangent_; }

  void reset();

 private:
  static constexpr double kSlowestRate = 0.2;  // largest convergence rate that the stopping rule assumes

  enum class Start { kWarm, kUnloaded, kDescent, kFineDescent };
  bool solveFrom(Start start, const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool guess(Start start, const DeadLoads& loads, Backbone& backbone);
  void extrapolateGuess(const DeadLoads& loads, Backbone& backbone);
  void balance(const DeadLoads& loads, Backbone& backbone);
  void rebuild(const DeadLoads& loads, Backbone& backbone);
  bool converge(Start start, const DeadLoads& loads, int most_iterations, Backbone& backbone, StaticsReport& report);
  bool linearise(const DeadLoads& loads, Linearisation how, Backbone& backbone, LinearisationResult& result);
  bool findTangent(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  bool solveCold(const DeadLoads& loads, Backbone& backbone, StaticsReport& report);
  double stableShare(const DeadLoads& loads, Backbone& backbone);
  double bendingOf(double moment) const { return bending_compliance_ * moment; }

  Chain chain_;
  double accuracy_;
  Discretisation discretisation_;
  NodalRotations shape_;
  EnergyDescent descent_;
  Matrix6 tangent_ = Matrix6::Zero();
  double bending_compliance_ = 0.0;  // L c_bt of the most compliant segment, rad / (N m)
  double stiffest_ = 0.0;            // rotation of the tip by a unit moment about its stiffest axis, unloaded, rad / (N m)
  double most_compliant_ = 0.0;      // the same about its most compliant axis
  double buckling_factor_ = 1.0;     // see StaticsReport, of the last solve
  double rate_;                      // convergence rate of the last iterations
  double normalised_load_ = 0.0;     // of the last cold start, see stability.h
  bool warm_ = false;                // the elements hold a solution
  bool has_sensitivities_ = false;   // the elements hold sensitivities of a shape nearby
  bool neutral_ = false;             // the last descent ended in a neutral equilibrium
  History history_ = History::kNone;  // what the last warm solve kept
  long solutions_ = 0;               // number of consecutive solutions on the same elements
};

}  // namespace live_stiffness
