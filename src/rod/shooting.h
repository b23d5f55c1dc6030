#pragma once
// Shooting along the chain: from a base moment to the residual moment at T, and its derivative by the base moment.

#include "rod/backbone.h"

namespace live_stiffness {

// Result of one iteration over all elements, from base to tip.
struct Sweep {
  Vector3 residual;     // moment at T that no load balances, N m, base axes
  double change = 0.0;  // largest change of an element
  bool is_admissible = false;   // finite, and no element bent too far
};

// Chain, loads and elements as plain data; the backbone's elements are what it refers to.
ChainState stateOf(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone);

// What a solve keeps of the solution from which it starts, so that the next solve can extrapolate the change.
enum class History {
  kNone,  // the nodes may still hold a guess for the same rest curvatures
  kShape,
  kSensitivities,  // both
};

// Sets lengths, sections and loads of the elements (element_count of them); once before the iterations. With a history the
// guess that they hold is moved along with the change of rest curvature. extrapolate: the same history of the same elements
// was kept by the last call, too. Returns the factor by which shape and sensitivities have been extrapolated: the present
// change as a multiple of the last one (1: the same; -1: back again), or 0 without extrapolation.
double prepare(const Chain& chain, const DeadLoads& loads, Backbone& backbone, History keep = History::kNone,
               bool extrapolate = false);

// One iteration over all elements, from base to tip, with the given base moment.
Sweep sweep(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, SweepMode mode, Backbone& backbone);

// Closed-form shape of a chain on which nothing external acts: constant strain per segment (6), exact. Fills elements,
// guess and X_BT from backbone.rest and the number of elements and stages that the backbone has.
void placeUnloaded(const Chain& chain, Backbone& backbone);

// Iterates until the shape has converged to rounding. False if it does not converge or is not admissible; then the nodes hold
// no guess.
bool shoot(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, bool nodes_hold_guess,
           Backbone& backbone, Vector3& residual);

// Sensitivities (columns): derivatives of the state at T with respect to [base moment, tip force]; their m is the derivative
// of the residual. The last iteration must have left the shape (any mode but kOnce). The start is the sensitivities that the
// elements hold, unless `cold`. Returns their largest estimated relative error in any element; infinity if one did not
// converge to `goal`. with_adjoint: also computes the adjoint-weighted residual (see ElementSensitivities), with which the
// error of the compliance is of order `goal` squared. Columns that are not in `set` are returned as zero.
double tipSensitivities(const Chain& chain, const DeadLoads& loads, bool cold, double goal, Backbone& backbone,
                        ElementSensitivities& columns, bool with_adjoint = false, SensitivitySet set = SensitivitySet::kAll);

}  // namespace live_stiffness
