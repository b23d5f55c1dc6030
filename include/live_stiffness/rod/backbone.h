#pragma once
// The shape of the robot: what kinematics (unloaded) and statics (loaded) both produce, and compliance reads.

#include <vector>

#include "live_stiffness/rod/rod_element.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

// Dead loads on a scene: gravity on every mass and a wrench at T (base axes).
struct DeadLoads {
  Vector3 gravity = Vector3::Zero();  // m/s^2
  Wrench tip = Wrench::Zero();        // [f; m], N and N m

  DeadLoads scaled(double factor) const { return {factor * gravity, factor * tip}; }
};

// Mutable result of a solve; built once for a scene, then reused without allocation.
struct Backbone {
  std::vector<RestState> rest;         // one per segment
  std::vector<int> element_count;      // one per segment
  std::vector<RodElement> elements;    // base to tip, element_count[k] of segment k; inside `capacity`
  Pose X_BT;                           // tip point

  static constexpr int kMaxElements = 64;  // per segment
  explicit Backbone(const Scene& scene);

  // First element of a segment in `elements`.
  int firstElement(int segment) const;
  // Stretched length of a segment, m.
  double length(const Scene& scene, int segment) const;
};

// Calls onSegment(index, segment) and onLink(link) from base to tip.
template <class OnSegment, class OnLink>
void walk(const Scene& scene, OnSegment on_segment, OnLink on_link) {
  int index = 0;
  for (const Body& body : scene.chain) {
    if (const auto* segment = std::get_if<Segment>(&body)) on_segment(index++, *segment);
    else on_link(std::get<Link>(body));
  }
}

// The piece of an element from its start to `length` (m), for reading values between its nodes. The wrenches and the
// pose at the start are kept; the nodes are solved anew, so the piece is as accurate as the element itself.
RodElement pieceOf(const RestState& rest, const RodElement& element, double length, bool loaded);

}  // namespace live_stiffness
