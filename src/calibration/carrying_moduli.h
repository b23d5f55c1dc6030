#pragma once
// Moduli that carry a robot, where those of its scene do not.

#include <optional>
#include <vector>

#include "live_stiffness/compliance/model_options.h"
#include "live_stiffness/lie/se3.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

constexpr double kFewShare = 0.05;   // of the samples of a recording, which may have no equilibrium
constexpr double kMostShare = 0.2;   // with more nothing is fitted

// Some samples of a recording, or rows of a table: a search for an equilibrium that is not there takes 0.2 s.
struct SamplesToCarry {
  std::vector<Pressures> pressures;  // Pa gauge, per chamber
  std::vector<Pose> X_AS;            // of the sensor, A axes; none of a table's rows
};

// How many of them have no equilibrium without a wrench; stops counting beyond `most`.
long withoutEquilibrium(const Scene& scene, const ModelOptions& options, const std::vector<SamplesToCarry>& samples, long most);

// A factor on all moduli of the scene with which at most kFewShare of them have no equilibrium: of 1.25 to 20 times the smallest
// such factor (1 to 16384 is searched, then 1 to 1/128), the one at which the poses are fitted best. None if none is found.
std::optional<double> carryingFactor(const Scene& scene, const ModelOptions& options,
                                     const std::vector<SamplesToCarry>& samples);

}  // namespace live_stiffness
