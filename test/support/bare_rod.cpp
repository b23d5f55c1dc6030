#include "support/bare_rod.h"

#include <stdexcept>

namespace live_stiffness {

Vector3 tipByMarchingFromTip(const BareRod& rod, const Vector3& tip_force, const Vector3& follower_load) {
  constexpr int kElements = 32;
  RodElement element;
  element.n_start = tip_force;
  element.follower_load = follower_load;
  element.length = -std::get<Segment>(rod.scene.chain[0]).length / kElements;
  for (int i = 0; i < kElements; ++i) {
    resetGuess(rod.rest, element);
    if (!integrate(rod.rest, element)) throw std::runtime_error("tipByMarchingFromTip: element too long");
    element.X_start = element.X_end;
    element.n_start = element.n_end;
    element.m_start = element.m_end;
  }
  return element.X_end.inverse().p;
}

}  // namespace live_stiffness
