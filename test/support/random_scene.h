#pragma once
// Random robots with random pressures and loads: chains of one to three segments, links and an offset tip, of any size
// and stiffness, driven from vacuum to well beyond the paper's pressures.

#include "live_stiffness/rod/scene.h"
#include "support/random_source.h"

namespace live_stiffness {

// Draws are made in numbers without unit, so that every robot bends about as much whatever its size:
//   pressure over modulus -0.2 to 1.2; weight of the whole chain times L^2 / (E I) up to `weight`; tip force times
//   L^2 / (E I) up to `force`; tip moment times L / (E I) up to `moment`, with L the length of the whole chain.
struct RandomSceneLimits {
  int segments = 3;
  double weight = 6.0;
  double force = 2.0;
  double moment = 1.0;
};

struct RandomScene {
  Scene scene;
  Pressures pressures;
  Wrench tip_wrench = Wrench::Zero();
};

RandomScene randomScene(RandomSource& random, const RandomSceneLimits& limits = {});

}  // namespace live_stiffness
