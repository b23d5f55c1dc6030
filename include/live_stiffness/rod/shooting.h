#pragma once
// One shot along the chain: from a base moment to the moment left over at T, and how that depends on the base moment.

#include "live_stiffness/rod/backbone.h"

namespace live_stiffness {

// What one pass over all elements, from base to tip, leaves.
struct Sweep {
  Vector3 residual;     // moment at T that nothing balances, N m, base axes
  double change = 0.0;  // largest change of an element
  bool sound = false;   // finite, and no element bent too far
};

// Gives the elements (as many as element_count says) their lengths, sections and loads, and lets the guess that they
// hold follow the change of rest curvature; once before sweeps.
void prepare(const Chain& chain, const DeadLoads& loads, Backbone& backbone);

enum class Pass {
  kOnce,    // one fixed-point pass an element
  kFinish,  // the same, and the shape and X_BT
  kAnew,    // every element integrated without a guess
};

// One sweep over all elements, from base to tip, under a base moment.
Sweep sweep(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, Pass pass, Backbone& backbone);

// Sweeps until the shape has converged to rounding. False if it does not, or is not sound; the nodes then hold no
// guess.
bool shoot(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, bool nodes_hold_guess,
           Backbone& backbone, Vector3& residual);

// Derivatives of the state at T with respect to [base moment, tip force] (columns), after a finished sweep; their m is
// that of the residual. Elements keep their columns as guess unless `fresh`. Returns the largest relative change of the last
// pass over an element, infinity if one did not converge to `goal`.
double tipColumns(const Chain& chain, const DeadLoads& loads, bool fresh, double goal, Backbone& backbone,
                  ElementColumns& columns);

}  // namespace live_stiffness
