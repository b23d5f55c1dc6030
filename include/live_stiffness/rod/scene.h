#pragma once
// A scene: what the robot is made of, from base to tip, and what acts on it. Plain data; see scene_file.h for YAML.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "live_stiffness/conventions.h"
#include "live_stiffness/section/cross_section.h"

namespace live_stiffness {

// Soft fluidic segment, straight along z when unpressurised.
struct Segment {
  std::string name;
  double length = 0.0;  // l0, unstretched, m
  CrossSection section;

  double mass() const { return section.linearDensity() * length; }  // kg
};

// Rigid part along z.
struct Link {
  double length = 0.0;  // m
  double mass = 0.0;    // kg, acts at its middle
};

using Body = std::variant<Segment, Link>;

struct Scene {
  std::vector<Body> chain;         // base to tip
  std::optional<Vector3> gravity;  // m/s^2, base axes; none: weightless
  double tip_mass = 0.0;           // kg, acts at T
  Vector3 tip_offset = Vector3::Zero();  // T from the chain's end, in its axes, m

  int segmentCount() const;
  int chamberCount() const;  // of all segments; pressures are ordered base to tip
  double length() const;     // unstretched, base to chain's end, m
  bool hasWeight() const;    // gravity acts on some mass
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

}  // namespace live_stiffness
