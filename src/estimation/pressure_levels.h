#pragma once
// Doubts about unit and reference of a rig's pressures, from their levels alone. Nothing is refused for them.

#include <string>

#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

class PressureLevels {
 public:
  // full_range: pressure for which the robot is made, Pa; 0: not known.
  explicit PressureLevels(double full_range) : full_range_(full_range) {}

  // One message: gauge, Pa, one per channel.
  void add(PressuresRef gauge);
  // What is doubtful, and the parameter to set; empty: nothing.
  std::string doubt() const;

 private:
  double full_range_;
  Pressures last_, lowest_, highest_;
  double steps_ = 0.0;  // sum of the changes of the pressure that changes most, Pa
  long count_ = 0;  // messages
};

// Pressure in all chambers that would stretch the softest segment of a scene to twice its length, without regard to geometry
// at large stretch, Pa; 0 without chambers.
double fullRange(const Scene& scene);

}  // namespace live_stiffness
