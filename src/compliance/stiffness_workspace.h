#pragma once
// Contents of a StiffnessWorkspace.

#include "live_stiffness/compliance/stiffness_model.h"
#include "rod/statics.h"

namespace live_stiffness {

struct StiffnessWorkspace::State {
  Backbone backbone;
  StaticsSolver statics;
  bool loaded = false;

  // stages: of every element, one of kStageCounts; 0: whatever is cheapest for the accuracy. Both instruction sets give
  // the same to rounding. These two are for benchmarks.
  State(const Scene& scene, double accuracy, int stages = 0, Simd simd = Simd::kBest)
      : backbone(scene, simd), statics(scene, accuracy, stages) {}
};

}  // namespace live_stiffness
