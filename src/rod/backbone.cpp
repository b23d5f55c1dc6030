#include "rod/backbone.h"

#include <numeric>

namespace live_stiffness {

Backbone::Backbone(const Scene& scene, Simd simd)
    : kernel(&elementKernel(kMaxStages, simd)),
      rest(scene.segmentCount()),
      element_count(scene.segmentCount(), 1),
      simd_(simd) {
  elements.reserve(static_cast<size_t>(scene.segmentCount()) * kMaxElements);
}

int Backbone::firstElement(int segment) const {
  return std::accumulate(element_count.begin(), element_count.begin() + segment, 0);
}

bool Backbone::resize(int stages) {
  const size_t count = std::accumulate(element_count.begin(), element_count.end(), size_t{0});
  bool changed = count != elements.size() || stages != kernel->stages;
  if (!changed) {
    // The total may be the same although single segments have other numbers.
    size_t next = 0;
    for (size_t segment = 0; segment < element_count.size(); ++segment)
      for (int k = 0; k < element_count[segment]; ++k)
        changed = changed || elements[next++].state.segment != static_cast<int>(segment);
  }
  if (!changed) return false;
  elements.resize(count);
  size_t next = 0;
  for (size_t segment = 0; segment < element_count.size(); ++segment)
    for (int k = 0; k < element_count[segment]; ++k) elements[next++].state.segment = static_cast<int>(segment);
  kernel = &elementKernel(stages, simd_);
  return true;
}

void Backbone::setTip(const double (&R)[9], const double (&p)[3]) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X_BT.R(i, j) = R[3 * i + j];
    X_BT.p[i] = p[i];
  }
}

}  // namespace live_stiffness
