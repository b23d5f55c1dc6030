#pragma once
// One shot along the chain: from a base moment to the moment left over at T, and how that depends on the base moment.

#include "rod/backbone.h"

namespace live_stiffness {

// What one pass over all elements, from base to tip, leaves.
struct Sweep {
  Vector3 residual;     // moment at T that nothing balances, N m, base axes
  double change = 0.0;  // largest change of an element
  bool sound = false;   // finite, and no element bent too far
};

// Chain, loads and elements as plain data; the backbone's elements are what it refers to.
ChainState stateOf(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone);

// What a solve keeps of the solution that it starts from, so that the next one can go on from its change.
enum class History {
  kNone,  // the nodes may still hold a guess for the same rest curvatures
  kShape,
  kColumns,  // both
};

// Gives the elements (as many as element_count says) their lengths, sections and loads; once before sweeps. With a
// history the guess that they hold follows the change of rest curvature. extrapolate: the same history was kept the last time,
// too, of these elements. Returns how far the change goes on as the last one did (1: the same; -1: back again; 0 if it
// does not, or may not), by which shape and columns have been extrapolated.
double prepare(const Chain& chain, const DeadLoads& loads, Backbone& backbone, History keep = History::kNone,
               bool extrapolate = false);

// One sweep over all elements, from base to tip, under a base moment.
Sweep sweep(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, Pass pass, Backbone& backbone);

// Sweeps until the shape has converged to rounding. False if it does not, or is not sound; the nodes then hold no
// guess.
bool shoot(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, bool nodes_hold_guess,
           Backbone& backbone, Vector3& residual);

// Derivatives of the state at T with respect to [base moment, tip force] (columns), for the shape of the last sweep but
// Pass::kOnce; their m is that of the residual. The elements' own columns are the guess unless `anew`. Returns what is
// estimated to be left of their error in any element, relative; infinity if one did not converge to `goal`. With their
// defect (see ElementColumns) they are of order `goal` squared where it is taken out, and cheaper. Columns that are not
// in `set` are returned as zero.
double tipColumns(const Chain& chain, const DeadLoads& loads, bool anew, double goal, Backbone& backbone,
                  ElementColumns& columns, bool with_defect = false, ColumnSet set = ColumnSet::kAll);

}  // namespace live_stiffness
