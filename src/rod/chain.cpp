#include "rod/chain.h"

namespace live_stiffness {

Chain::Chain(const Scene& scene) : mass(scene.tip_mass), tip_mass(scene.tip_mass), tip_offset(scene.tip_offset) {
  walk(
      scene,
      [&](int index, const Segment& segment) { parts.push_back({index, segment.length, segment.mass()}); },
      [&](const Link& link) { parts.push_back({-1, link.length, link.mass}); });
  for (const Part& part : parts) mass += part.mass;
}

}  // namespace live_stiffness
