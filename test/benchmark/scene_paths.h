#pragma once
// The scenes of the speed report and the pressures that are run through them.

#include <vector>

#include "benchmark/methods/stiffness_method.h"
#include "support/errors.h"
#include "support/scenes.h"

namespace live_stiffness {

// A closed path of 128 pressures, up and down between 0.4 and 0.75 bar in steps of 1 %, with one pair (of each segment)
// at 60 % of the first.
std::vector<Pressures> pressurePath(int segments);

// A closed path of 10 000 pressures of one segment, always the same: each pair goes up or down by 1 %, at random, between
// 0.1 and 0.75 bar; back the way it came.
std::vector<Pressures> pressureWalk();

// Relative errors of a solution against another.
struct SolutionErrors {
  double pose = 0.0, tangent = 0.0, material = 0.0;

  double largest() const { return std::max({pose, tangent, material}); }
};

template <class Solution, class Exact>
SolutionErrors errorsOf(const Solution& solution, const Exact& exact, double length) {
  return {poseError(solution.X_BT, exact.X_BT, length),
          complianceError(solution.compliance, exact.compliance, length),
          complianceError(solution.material_compliance, exact.material_compliance, length)};
}

// The library's solution of each pressure, by default at accuracy 1e-12, cold. A scene without weight is solved as a boundary
// value problem, so that the closed form is not compared with itself.
std::vector<StiffnessSolution> exactSolutions(const Scene& scene, const std::vector<Pressures>& path,
                                              double accuracy = 1e-12);

}  // namespace live_stiffness
