#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

int Scene::segmentCount() const {
  int count = 0;
  for (const Body& body : chain) count += std::holds_alternative<Segment>(body);
  return count;
}

int Scene::chamberCount() const {
  int count = 0;
  for (const Body& body : chain)
    if (const auto* segment = std::get_if<Segment>(&body)) count += segment->section.chambers.count();
  return count;
}

double Scene::length() const {
  double sum = 0.0;
  for (const Body& body : chain) sum += std::visit([](const auto& part) { return part.length; }, body);
  return sum;
}

bool Scene::hasWeight() const {
  if (!gravity || gravity->isZero(0.0)) return false;
  double mass = tip_mass;
  for (const Body& body : chain) {
    if (const auto* segment = std::get_if<Segment>(&body)) mass += segment->mass();
    if (const auto* link = std::get_if<Link>(&body)) mass += link->mass;
  }
  return mass > 0.0;
}

}  // namespace live_stiffness
