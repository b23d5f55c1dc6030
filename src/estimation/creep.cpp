#include "estimation/creep.h"

#include <algorithm>

namespace live_stiffness {
namespace {

Material firstMaterial(const Scene& scene) {
  for (const Body& body : scene.chain)
    if (const auto* segment = std::get_if<Segment>(&body)) return segment->section.material;
  return Material();
}

}  // namespace

SceneCreep::SceneCreep(const Scene& scene)
    : share_(firstMaterial(scene).creep_share), filter_(share_, firstMaterial(scene).creep_time) {}

const Pressures& SceneCreep::update(PressuresRef pressures, double time) {
  constexpr double kClockSet = 1.0;  // s
  if (time < time_ - kClockSet) filter_.reset();
  const double elapsed = std::max(0.0, time - time_);
  time_ = time < time_ - kClockSet ? time : std::max(time_, time);
  return filter_.update(pressures, elapsed);
}

}  // namespace live_stiffness
