#pragma once
// Fig. 17 of the paper: by how much rotation matrices leave SO(3) along a bent segment, at P1 = P2 = 1.5 bar and
// P3 = P4 = 1.0 bar, when RK4 integrates their entries, and in this library. One segment, by its six pressures.

#include <vector>

#include "support/scenes.h"

namespace live_stiffness {

// The paper prints neither model nor weight for the figure. Its values (below 2.5e-10 at 50 elements) are those of the
// linear model without weight, which bends by 1.27 rad; the error goes with the sixth power of bending.
struct OrthonormalityCase {
  Stepping stepping = Stepping::kFixedStep;
  bool has_weight = true;
};
constexpr OrthonormalityCase kFigure17{Stepping::kLinear, false};

// Errors (52) of the literal (36) integrated by RK4 after every one of `elements` steps, base first: elements + 1.
std::vector<double> rungeKuttaOrthonormality(const OrthonormalityCase& which, int elements);

// Errors (52) of the library's default solver at equally spaced stations from base to tip.
struct SolverOrthonormality {
  int elements = 0;  // that it chose
  std::vector<double> errors;
};
SolverOrthonormality solverOrthonormality(const OrthonormalityCase& which, int stations);

// Bending of the segment without weight, rad.
double unloadedBending(const OrthonormalityCase& which);

}  // namespace live_stiffness
