#include "support/bare_rod.h"

#include <stdexcept>

namespace live_stiffness {

Vector3 tipByMarchingFromTip(const BareRod& rod, const Vector3& tip_force, const Vector3& follower_load) {
  constexpr int kElements = 32;
  const ElementKernel& kernel = elementKernel(kMaxStages, Simd::kBest);
  RodElement element;
  element.setSection(rod.rest);
  element.setLoads(Vector3::Zero(), follower_load);
  element.setStart(Pose(), tip_force, Vector3::Zero());
  element.state.length = -std::get<Segment>(rod.scene.chain[0]).length / kElements;
  for (int i = 0; i < kElements; ++i) {
    if (!integrate(kernel, true, element)) throw std::runtime_error("tipByMarchingFromTip: element too long");
    element.setStart(element.X_end(), element.n_end(), element.m_end());
  }
  return element.X_start().inverse().p;
}

}  // namespace live_stiffness
