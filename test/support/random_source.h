#pragma once
// Random arguments with a fixed seed: the same on every machine and in every run, because the standard fixes
// mt19937 (but not its distributions, which are therefore not used).

#include <random>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

class RandomSource {
 public:
  explicit RandomSource(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * (engine_() / 4294967295.0); }

  Vector3 vector(double largest) {
    const double x = uniform(-largest, largest), y = uniform(-largest, largest);
    return {x, y, uniform(-largest, largest)};
  }

  // A vector of exactly this length in a random direction.
  Vector3 direction(double length) { return length * (vector(1.0) + Vector3(0.1, 0.0, 0.0)).normalized(); }

  Wrench wrench(double force, double moment) {
    Wrench result;
    linear(result) = vector(force);
    angular(result) = vector(moment);
    return result;
  }

  // Gauge pressures in pairs of neighbours, as the paper's robot is driven.
  Pressures pairs(int count, double low, double high) {
    Pressures pressures(count);
    for (int k = 0; k < count; ++k) pressures[k] = k % 2 == 0 ? uniform(low, high) : pressures[k - 1];
    return pressures;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace live_stiffness
