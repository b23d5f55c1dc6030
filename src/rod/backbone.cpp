#include "live_stiffness/rod/backbone.h"

namespace live_stiffness {

Backbone::Backbone(const Scene& scene)
    : rest(scene.segmentCount()), element_count(scene.segmentCount(), 1) {
  elements.reserve(static_cast<size_t>(scene.segmentCount()) * kMaxElements);
}

int Backbone::firstElement(int segment) const {
  int first = 0;
  for (int k = 0; k < segment; ++k) first += element_count[k];
  return first;
}

double Backbone::length(const Scene& scene, int segment) const {
  double result = 0.0;
  walk(
      scene,
      [&](int index, const Segment& body) {
        if (index == segment) result = rest[index].stretch * body.length;
      },
      [](const Link&) {});
  return result;
}

RodElement pieceOf(const RestState& rest, const RodElement& element, double length, bool loaded) {
  RodElement piece = element;
  const double ratio = length / element.length;
  piece.length = length;
  if (!loaded) {
    placeUnloaded(rest, piece);
  } else {
    piece.rotation *= ratio;
    integrate(rest, piece);  // shorter than a converged element, so it converges
  }
  return piece;
}

}  // namespace live_stiffness
