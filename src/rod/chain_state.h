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

// Result of one fixed-point iteration of every element from its own start.
struct IterationResult {
  double change;       // of the Cayley vectors, sum over the elements, rad
  double turn;         // largest gap of rotation at a joint, rad
  double moment;       // largest of moment at a joint or at T, N m
  double lacking[3];   // moment at T: the load less what the shape gives, N m, base axes
  bool is_admissible;  // finite, and no element bent too far
};

enum class MarchMode {
  kShape,     // no iteration: evaluates the shape of the guess
  kClose,     // the same, but with the moment at its start that every element has
  kIterate,   // one fixed-point iteration of each element, then kShape
  kCold,      // integrates every element without a guess
  kUnloaded,  // sets every element to its shape without loads, as a guess
};

// Result of a walk from base to tip in which every element starts where the one before ends.
struct MarchResult {
  double R_tip[9], p_tip[3];  // of T
  double residual[3];         // moment at T that no load balances, N m, base axes
  double gap;                 // largest of the residual and of gaps of moment at joints (kClose), N m
  double change;              // largest change of an element, rad
  bool is_admissible;         // finite, and no element bent too far
};

struct Linearisation {
  double goal;                // relative error of the sensitivities at which iterations stop
  bool cold = true;           // without a guess
  bool with_force = false;    // also those by a force, for tangent()
  bool with_adjoint = false;  // also the adjoint-weighted residual, with which the compliance's error is of order goal squared
  bool clamped = false;       // T cannot turn
};
struct LinearisationResult {
  double left;   // largest relative error of the sensitivities of an element; infinity if one did not converge
  int unstable;  // in how many directions the energy does not grow; 0 if the equilibrium is stable
};

}  // namespace live_stiffness
