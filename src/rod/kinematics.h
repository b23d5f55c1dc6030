#pragma once
// Closed-form shape of a scene on which nothing external acts: constant strain per segment (6), exact.

#include "rod/backbone.h"

namespace live_stiffness {

// Fills elements, guess and X_BT of the backbone, from its rest states and its number of elements and stages.
void placeUnloaded(const Chain& chain, Backbone& backbone);

}  // namespace live_stiffness
