#include "live_stiffness/rod/kinematics.h"

namespace live_stiffness {

void placeUnloaded(const Chain& chain, Backbone& backbone) {
  Pose X;
  auto element = backbone.elements.begin();
  for (const Chain::Part& part : chain.parts) {
    if (part.segment < 0) {
      X.p += part.length * X.R.col(2);
      continue;
    }
    const RestState& rest = backbone.rest[part.segment];
    const int count = backbone.element_count[part.segment];
    for (int k = 0; k < count; ++k, ++element) {
      element->state.length = rest.stretch * part.length / count;
      element->start = k * element->state.length;
      element->setSection(rest);
      element->setStart(X, Vector3::Zero(), Vector3::Zero());
      element->setLoads(Vector3::Zero());
      backbone.passes->place_unloaded(element->state);
      X = element->X_end();
    }
  }
  backbone.X_BT = {X.R, X * chain.tip_offset};
}

}  // namespace live_stiffness
