#pragma once
// What is done to an element, as plain functions, for one number of stages and one instruction set.

#include "live_stiffness/rod/element_state.h"

namespace live_stiffness {

struct ElementPasses {
  int stages;
  // One fixed-point pass over the nodes, from g to g; then the end values, change and size.
  void (*pass)(ElementState&);
  // The same, and the shape at the nodes, the offset of the end and truncation.
  void (*finish)(ElementState&);
  // Shape, and g, of a rod under u_rest alone. Exact, for at most kMaxUnloadedBending rad.
  void (*place_unloaded)(ElementState&);
  // Matrices of the linearised rod, after finish().
  void (*linearise)(ElementState&);
  // One fixed-point pass over the columns at the nodes, from these values at the start.
  void (*column_pass)(ElementState&, const ElementColumns& start);
  // Moves the guess g along with a change of the base moment (N m), to first order, by the columns held.
  void (*follow)(ElementState&, const double (&base_moment_change)[3]);
  // Columns at the end from those at the nodes.
  void (*column_end)(ElementState&, const ElementColumns& start, ElementColumns& end);
  // What stations() needs for this relative accuracy (see station_error for what comes of it), and the integral of
  // material compliance; after place_unloaded(), or after finish() under dead loads.
  void (*material)(ElementState&, bool unloaded, double accuracy);
  // Sections between the nodes, after material().
  void (*stations)(const ElementState&, const StationBatch&);
};

constexpr double kMaxUnloadedBending = 1.6;  // rad an element

// Which instruction set an element is computed with.
enum class Simd {
  kBest,      // what this processor has
  kBaseline,  // what every processor of this architecture has
};

// stages: kMinStages to kMaxStages.
const ElementPasses& elementPasses(int stages, Simd simd);

// Instruction set that kBest stands for here: "AVX2" or "baseline".
const char* bestSimdName();

}  // namespace live_stiffness
