#pragma once
// Closed-form shape of a scene on which nothing external acts: constant strain per segment (6), exact.

#include "live_stiffness/rod/backbone.h"

namespace live_stiffness {

// Sets element_count for a shape without loads, so that the compliance quadrature over each element is exact to
// rounding: at most 1.5 rad of bending an element.
void chooseUnloadedElements(const Scene& scene, Backbone& backbone);

// Fills elements and X_BT from backbone.rest and backbone.element_count.
void placeUnloaded(const Scene& scene, Backbone& backbone);

}  // namespace live_stiffness
