#pragma once
// Random cycles of pressure that start and end at zero, as a regulator would drive them.

#include <algorithm>
#include <array>
#include <cmath>

#include "support/random_source.h"

namespace live_stiffness {

// Calls onStep(pressures) along one cycle: straight from zero through two random pressures in pairs (up to `highest`,
// Pa) and back to zero, in equal increments of each leg of which the largest chamber's is at most `threshold` (Pa).
// The last call is with exactly zero pressure.
template <class OnStep>
void pressureCycle(RandomSource& random, int chambers, double highest, double threshold, OnStep on_step) {
  const Pressures rest = Pressures::Zero(chambers);
  const std::array<Pressures, 4> corners = {rest, random.pairs(chambers, 0.0, highest),
                                            random.pairs(chambers, 0.0, highest), rest};
  Pressures at(chambers);
  for (size_t leg = 1; leg < corners.size(); ++leg) {
    const double largest = (corners[leg] - corners[leg - 1]).cwiseAbs().maxCoeff();
    const int steps = std::max(1, static_cast<int>(std::ceil(largest / threshold)));
    for (int step = 1; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      at = share * corners[leg] + (1.0 - share) * corners[leg - 1];
      on_step(at);
    }
  }
}

}  // namespace live_stiffness
