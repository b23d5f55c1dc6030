#include "estimation/creep.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

Material firstMaterial(const Scene& scene) {
  for (const Body& body : scene.chain)
    if (const auto* segment = std::get_if<Segment>(&body)) return segment->section.material;
  return Material();
}

}  // namespace

SceneCreep::SceneCreep(const Scene& scene)
    : share_(firstMaterial(scene).creep_share), time_constant_(firstMaterial(scene).creep_time) {}

const Pressures& SceneCreep::update(PressuresRef pressures, double time) {
  constexpr double kClockSet = 1.0;  // s
  const bool set_back = time < time_ - kClockSet;
  const double elapsed = std::max(0.0, time - time_);
  time_ = set_back ? time : std::max(time_, time);
  if (set_back || late_.size() != pressures.size()) late_ = pressures;
  else late_ += (pressures - late_) * (1.0 - std::exp(-elapsed / time_constant_));
  effective_ = pressures * (1.0 - share_) + late_ * share_;
  return effective_;
}

}  // namespace live_stiffness
