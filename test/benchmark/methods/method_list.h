#pragma once
// Every method that the report measures.

#include <functional>
#include <memory>
#include <vector>

#include "benchmark/methods/stiffness_method.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

struct MethodEntry {
  std::string family;    // one line of a plot: "common practice", "RK4 with sensitivities", "library by stages", ...
  std::string variant;   // a point on it: "N=50", "4 elements", "accuracy 1e-6"
  double resolution;     // what the variant varies: steps, elements, stages or accuracy
  std::function<std::unique_ptr<StiffnessMethod>(const Scene&)> make;
};

std::vector<MethodEntry> methodList();

// What "library by stages" is asked for with that many stages: about what one element then gives, since the accuracy
// also decides where the solver stops.
double accuracyOfStages(int stages);

}  // namespace live_stiffness
