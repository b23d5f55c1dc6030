#pragma once
// Moduli that carry a robot, where those of its scene do not.

#include <optional>
#include <vector>

#include "live_stiffness/compliance/model_options.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

constexpr double kFewShare = 0.05;  // of the samples of a recording, which may have no equilibrium

// How many of these pressures (Pa gauge, per chamber) have no equilibrium without a wrench; stops counting beyond `most`.
long withoutEquilibrium(const Scene& scene, const ModelOptions& options, const std::vector<Pressures>& pressures, long most);

// A factor on all moduli of the scene, a quarter above the smallest one with which at most kFewShare of these pressures have no
// equilibrium. 1/128 to 16384 is searched; none if none is found.
std::optional<double> carryingFactor(const Scene& scene, const ModelOptions& options, const std::vector<Pressures>& pressures);

}  // namespace live_stiffness
