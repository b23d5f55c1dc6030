#pragma once
// A rod whose rest strain and compliance are given directly, for classical rod problems: statics takes both from the
// backbone, the section says nothing.

#include <limits>

#include "rod/statics.h"

namespace live_stiffness {

// Length L (m), mass 1 kg, along z.
struct BareRod {
  Scene scene;
  RestState rest;

  BareRod(double length, double EI, double GJ, double GA, double EA) {
    Segment segment;
    segment.length = length;
    segment.section.outer_radius = 0.01 * length;
    segment.section.density = 1.0 / (segment.section.area(1.0) * length);
    scene.chain.push_back(segment);
    rest.c.shear_elongation.diagonal() << 1.0 / GA, 1.0 / GA, 1.0 / EA;
    rest.c.bending_torsion.diagonal() << 1.0 / EI, 1.0 / EI, 1.0 / GJ;
  }

  // EI = GJ = L = 1 without shear and elongation. Infinite stiffness is exact, because only compliances enter.
  static BareRod elastica() {
    constexpr double kRigid = std::numeric_limits<double>::infinity();
    return {1.0, 1.0, 1.0, kRigid, kRigid};
  }

  Backbone backbone() const {
    Backbone result(scene);
    result.rest[0] = rest;
    return result;
  }
};

}  // namespace live_stiffness
