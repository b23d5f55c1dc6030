#pragma once
// What a scene means, for a look before it is believed; and what in it looks like a slip.

#include <string>
#include <vector>

#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

// Values that are legal but look like the usual slips: a diameter for a radius, radians for degrees, mm or g for SI, kPa or
// MPa for Pa, g/cm3 for kg/m3, chambers that overlap. Each text says the value, why it is doubtful and the way out. Closed
// form; never throws.
std::vector<std::string> doubtsAbout(const Scene& scene);

// Lengths, masses, gravity, the tip at rest and its compliance, the margin to buckling, and where a pressure of 1 bar in each
// chamber moves the tip; then the doubts. Several lines; base axes. scene: as loaded, so with a segment.
std::string describeScene(const Scene& scene);

}  // namespace live_stiffness
