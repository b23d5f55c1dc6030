#pragma once
// The innermost computations on elements and chains, as plain functions, for one number of stages and one instruction set.

#include "rod/chain_state.h"

namespace live_stiffness {

struct ElementKernel {
  int stages;

  // One element.

  // Starts the iterations from the unloaded shape under a constant moment.
  void (*reset_guess)(ElementState&);
  // Moves the guess along with a change of rest curvature, given as an angle at the end of the element, rad.
  // `extrapolation`: this change as a multiple of the last one, or 0. Moves so many columns of the sensitivities, too.
  void (*predict)(ElementState&, const double (&turn)[3], double extrapolation, int columns);
  // Iterates until the shape has converged to rounding, then fills all of ElementState. False without convergence.
  bool (*integrate)(ElementState&);
  // Shape, and g, of a rod under u_rest alone. Exact, for at most kMaxUnloadedBending rad.
  void (*place_unloaded)(ElementState&);
  // Moves the guess g along with a change of what the columns are by, to first order. R_start and the loads stay as they are.
  void (*follow)(ElementState&, const double (&change)[kColumns]);
  // Fills ElementState::transfer by iterations until the columns change by less than `goal`, relative, from the guess that
  // the element holds or cold. Call it when the shape has been evaluated. Returns what is estimated to be left; infinity
  // without convergence.
  double (*propagate)(ElementState&, bool cold, bool with_force, bool with_rotation, double goal, bool with_adjoint);
  // Material compliance, and what stations() needs for this relative accuracy (station_error is the error estimate). Call
  // it after place_unloaded(), or after the shape under dead loads.
  void (*material)(ElementState&, bool unloaded, double accuracy);
  // end_compliance from start_compliance and that of the element.
  void (*add_compliance)(ElementState&);
  // Sections between the nodes, after material() and with start_compliance set. The batch is for dense_nodes.
  void (*stations)(const ElementState&, const StationBatch&, const StationResults&);

  // A chain: see chain_state.h.

  // One fixed-point iteration of every element from its own start.
  void (*iterate_all)(const ChainState&, IterationResult&);
  // Evaluates the shape of every element from its own start.
  void (*evaluate_all)(const ChainState&);
  // Newton's step of multiple shooting, after linearise(); no section turns by more than `most`, rad. Returns the largest turn
  // that the step wanted.
  double (*correct)(const ChainState&, const IterationResult&, double most);
  // From base to tip.
  void (*march)(const ChainState&, MarchMode, MarchResult&);
  // Sensitivities of all elements, and the factors of the Riccati sweep. After evaluate_all() or march().
  LinearisationResult (*linearise)(const ChainState&, const Linearisation&);
  // After linearise() with_force: the compliance of T under a dead wrench [f; m] at T, base axes, with the adjoint-weighted
  // residuals subtracted if `correct`. 6x6, column-major.
  void (*tangent)(ElementState* elements, int count, bool correct, double* compliance);
  // Material compliance of the whole chain about T, which is at p_tip, and of the part before each element. Call it after
  // the shape under dead loads.
  void (*accumulate)(const ChainState&, double accuracy, const double (&p_tip)[3], PackedRow& compliance);
  // The same of a chain on which nothing external acts, with its shape. Sets R_tip and p_tip of the result. Returns how many
  // elements bend by more than kMaxUnloadedBending.
  int (*place_chain)(const ChainState&, double accuracy, MarchResult&, PackedRow& compliance);
};

constexpr double kMaxUnloadedBending = 1.6;  // rad an element

// Which instruction set an element is computed with.
enum class Simd {
  kBest,      // what this processor has
  kBaseline,  // what every processor of this architecture has
};

// stages: one of kStageCounts.
const ElementKernel& elementKernel(int stages, Simd simd);

// Instruction set that kBest stands for here: "AVX2" or "baseline".
const char* bestSimdName();

}  // namespace live_stiffness
