#include "live_stiffness/rod/chain.h"

namespace live_stiffness {

Chain::Chain(const Scene& scene) : mass(scene.tip_mass), tip_mass(scene.tip_mass), tip_offset(scene.tip_offset) {
  int segments = 0;
  for (const Body& body : scene.chain) {
    if (const auto* segment = std::get_if<Segment>(&body))
      parts.push_back({segments++, segment->length, segment->mass()});
    else
      parts.push_back({-1, std::get<Link>(body).length, std::get<Link>(body).mass});
    mass += parts.back().mass;
  }
}

}  // namespace live_stiffness
