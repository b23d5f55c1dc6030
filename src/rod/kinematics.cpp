#include "live_stiffness/rod/kinematics.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {

void chooseUnloadedElements(const Scene& scene, Backbone& backbone) {
  constexpr double kMaxBending = 1.5;  // rad an element
  walk(
      scene,
      [&](int index, const Segment& segment) {
        const RestState& rest = backbone.rest[index];
        const double bending = rest.stretch * segment.length * rest.curvature.norm();
        const double count = std::clamp(std::ceil(bending / kMaxBending), 1.0, double{Backbone::kMaxElements});
        backbone.element_count[index] = static_cast<int>(count);
      },
      [](const Link&) {});
}

void placeUnloaded(const Scene& scene, Backbone& backbone) {
  Pose X;
  backbone.elements.clear();
  walk(
      scene,
      [&](int index, const Segment& segment) {
        const RestState& rest = backbone.rest[index];
        const int count = backbone.element_count[index];
        for (int k = 0; k < count; ++k) {
          RodElement& element = backbone.elements.emplace_back();
          element.segment = index;
          element.length = rest.stretch * segment.length / count;
          element.start = k * element.length;
          element.X_start = X;
          placeUnloaded(rest, element);
          X = element.X_end;
        }
      },
      [&](const Link& link) { X.p += X.R.col(2) * link.length; });
  backbone.X_BT = {X.R, X * scene.tip_offset};
}

}  // namespace live_stiffness
