#pragma once
// The innermost computations on elements and chains, as plain functions, for one number of stages and one instruction set.

#include "rod/chain_state.h"

namespace live_stiffness {

struct ElementKernel {
  int stages;

  // One element.

  // Starts the iterations from the unloaded shape under a constant moment.
  void (*reset_guess)(ElementState&);
  // Moves the guess g along with a change of rest curvature, given as an angle at the end of the element, rad.
  // `extrapolation`: this change as a multiple of the last one, or 0. Optionally moves the sensitivities, too.
  void (*predict)(ElementState&, const double (&turn)[3], double extrapolation, bool with_sensitivities);
  // One fixed-point iteration over the nodes, from g to g; then the end values, change and size.
  void (*iterate)(ElementState&);
  // Iterates until the shape has converged to rounding, then fills all of ElementState. False without convergence.
  bool (*integrate)(ElementState&);
  // Shape, and g, of a rod under u_rest alone. Exact, for at most kMaxUnloadedBending rad.
  void (*place_unloaded)(ElementState&);
  // Moves the guess g along with a change of the base moment (N m), to first order, by the stored sensitivities.
  void (*follow)(ElementState&, const double (&base_moment_change)[3]);
  // Sensitivities at the end from those at the start, see propagate().
  double (*propagate)(ElementState&, bool cold, const ElementSensitivities& start, SensitivitySet set, double goal,
                      bool with_adjoint, ElementSensitivities& end);
  // Material compliance, and what stations() needs for this relative accuracy (station_error is the error estimate). Call
  // it after place_unloaded(), or after the shape under dead loads.
  void (*material)(ElementState&, bool unloaded, double accuracy);
  // end_compliance from start_compliance and that of the element.
  void (*add_compliance)(ElementState&);
  // Sections between the nodes, after material() and with start_compliance set. The batch is for dense_nodes.
  void (*stations)(const ElementState&, const StationBatch&, const StationResults&);

  // A chain.

  // One iteration over all elements, from base to tip, with the base moment (a sweep).
  void (*sweep)(const ChainState&, SweepMode, SweepResult&);
  // follow() for each element.
  void (*follow_all)(const ChainState&, const double (&base_moment_change)[3]);
  // See tipSensitivities().
  double (*columns)(const ChainState&, bool cold, SensitivitySet set, double goal, bool with_adjoint,
                    ElementSensitivities& tip);
  // From the sensitivities at the tip: inverse of the derivative of the residual with respect to the base moment, and the
  // compliance of T under a dead wrench [f; m] at T; with their adjoint_residual subtracted if `correct`. 3x3 and
  // 6x6, column-major.
  void (*tangent)(const ElementSensitivities& tip, bool correct, double* inverse, double* compliance);
  // Material compliance of the whole chain about T, which is at p_tip, and of the part before each element. Call it after
  // the shape under dead loads. Returns an estimate of the relative error that this adds to that of the shape.
  double (*accumulate)(const ChainState&, double accuracy, const double (&p_tip)[3], PackedRow& compliance);
  // The same of a chain on which nothing external acts, with its shape. Sets R_tip and p_tip of the result.
  double (*place_chain)(const ChainState&, double accuracy, SweepResult&, PackedRow& compliance);
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
