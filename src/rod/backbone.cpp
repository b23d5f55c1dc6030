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

void Backbone::resize(const std::vector<int>& count, int stages) {
  element_count = count;
  elements.resize(std::accumulate(count.begin(), count.end(), size_t{0}));
  size_t next = 0;
  for (size_t segment = 0; segment < count.size(); ++segment)
    for (int k = 0; k < count[segment]; ++k) elements[next++].state.segment = static_cast<int>(segment);
  kernel = &elementKernel(stages, simd_);
}

void Backbone::setTip(const double (&R)[9], const double (&p)[3]) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X_BT.R(i, j) = R[3 * i + j];
    X_BT.p[i] = p[i];
  }
}

}  // namespace live_stiffness
