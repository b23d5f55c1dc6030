#pragma once
// A chain and what acts on it as plain data, for code that is compiled for another instruction set (see
// element_state.h).

#include "rod/element_state.h"

namespace live_stiffness {

// One body of a chain.
struct ChainPart {
  int segment;    // index of the segment, -1: rigid link
  double length;  // unstretched, m
  double mass;    // kg; of a segment spread along it, of a link at its middle
};

struct ChainState {
  const ChainPart* parts;  // base to tip
  int part_count;
  const int* element_count;  // of each segment
  ElementState* elements;    // base to tip
  double gravity[3];         // m/s^2, base axes
  double base_force[3];      // external loads of everything, N
  double base_moment[3];     // unknown, N m
  double tip_offset[3];      // T from the chain's end, in its axes, m
  double tip_moment[3];      // dead, at T, N m
};

// Result of one iteration over all elements, from base to tip.
struct SweepResult {
  double R_tip[9], p_tip[3];  // of T; not after SweepMode::kOnce
  double residual[3];         // moment at T that no load balances, N m, base axes
  double change;              // largest change of an element
  bool is_admissible;                 // finite, and no element bent too far
};

enum class SweepMode {
  kOnce,      // one fixed-point iteration of each element
  kShape,     // no iteration: evaluates the shape of the guess, and its end
  kFinish,    // kOnce, then kShape
  kCold,      // integrates every element without a guess
  kUnloaded,  // sets every element to its shape without loads, as a guess
};

}  // namespace live_stiffness
