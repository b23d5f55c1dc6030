#pragma once
// The same robot in other units: lengths times `length`, forces times `force`, time as it is.

#include "live_stiffness/lie/se3.h"
#include "support/scenes.h"

namespace live_stiffness {

struct Units {
  double length = 1.0, force = 1.0;  // numbers per m and per N

  double pressure() const { return force / (length * length); }
  double mass() const { return force / length; }

  Scene scale(Scene scene) const {
    for (Body& body : scene.chain) {
      if (auto* link = std::get_if<Link>(&body)) {
        link->length *= length;
        link->mass *= mass();
        continue;
      }
      Segment& segment = std::get<Segment>(body);
      CrossSection& section = segment.section;
      for (double* x : {&segment.length, &section.outer_radius, &section.lumen_radius, &section.chambers.radius,
                        &section.chambers.pitch_radius})
        *x *= length;
      section.youngs_modulus *= pressure();
      section.shear_modulus *= pressure();
      section.density *= mass() / (length * length * length);
    }
    scene.tip_mass *= mass();
    scene.tip_offset *= length;
    if (scene.gravity) *scene.gravity *= length;
    return scene;
  }
  Wrench scale(Wrench wrench) const {
    linear(wrench) *= force;
    angular(wrench) *= force * length;
    return wrench;
  }
  Pose toMetres(Pose X) const {
    X.p /= length;
    return X;
  }
  Matrix6 toSi(Matrix6 C) const {  // compliance
    C.topLeftCorner<3, 3>() *= force / length;
    C.topRightCorner<3, 3>() *= force;
    C.bottomLeftCorner<3, 3>() *= force;
    C.bottomRightCorner<3, 3>() *= force * length;
    return C;
  }
};

}  // namespace live_stiffness
