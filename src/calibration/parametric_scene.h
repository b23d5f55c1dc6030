#pragma once
// A scene whose numbers may carry derivatives, and how the parameters of a calibration change it.

#include "calibration/scene_parameter.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

template <class T>
struct ParametricBody {
  bool is_segment = false;
  T length = T(0.0);          // m; of a segment unstretched
  T mass = T(0.0);            // kg; of a link
  CrossSectionOf<T> section;  // of a segment
};

template <class T>
struct ParametricScene {
  std::vector<ParametricBody<T>> chain;
  Vector3 gravity = Vector3::Zero();  // m/s^2
  T tip_mass = T(0.0);                // kg
  Vector3 tip_offset = Vector3::Zero();
};

template <class T>
CrossSectionOf<T> castSection(const CrossSection& from) {
  CrossSectionOf<T> to;
  to.outer_radius = T(from.outer_radius);
  to.lumen_radius = T(from.lumen_radius);
  to.chambers.radius = T(from.chambers.radius);
  to.chambers.pitch_radius = T(from.chambers.pitch_radius);
  for (double azimuth : from.chambers.azimuths) to.chambers.azimuths.push_back(T(azimuth));
  to.chambers.area_growth = T(from.chambers.area_growth);
  to.youngs_modulus = T(from.youngs_modulus);
  to.shear_modulus = T(from.shear_modulus);
  to.shear_correction = T(from.shear_correction);
  to.density = T(from.density);
  to.material.law = from.material.law;
  to.material.gent_limit = T(from.material.gent_limit);
  to.material.yeoh_c2 = T(from.material.yeoh_c2);
  to.material.yeoh_c3 = T(from.material.yeoh_c3);
  to.material.pressure_stiffening = T(from.material.pressure_stiffening);
  to.material.creep_share = T(from.material.creep_share);
  to.material.creep_time = T(from.material.creep_time);
  return to;
}

template <class T>
ParametricScene<T> castScene(const Scene& scene) {
  ParametricScene<T> result;
  for (const Body& body : scene.chain) {
    ParametricBody<T>& to = result.chain.emplace_back();
    if (const auto* segment = std::get_if<Segment>(&body)) {
      to.is_segment = true;
      to.length = T(segment->length);
      to.section = castSection<T>(segment->section);
    } else {
      to.length = T(std::get<Link>(body).length);
      to.mass = T(std::get<Link>(body).mass);
    }
  }
  result.gravity = scene.gravity.value_or(Vector3::Zero());
  result.tip_mass = T(scene.tip_mass);
  result.tip_offset = scene.tip_offset;
  return result;
}

// The member of a body that a parameter names, or nullptr.
template <class T>
T* numberOf(ParametricBody<T>& body, ParameterKind kind) {
  CrossSectionOf<T>& section = body.section;
  switch (kind) {
    case ParameterKind::kYoungsModulus: return &section.youngs_modulus;
    case ParameterKind::kShearModulus: return &section.shear_modulus;
    case ParameterKind::kShearCorrection: return &section.shear_correction;
    case ParameterKind::kLength: return &body.length;
    case ParameterKind::kPitchRadius: return &section.chambers.pitch_radius;
    case ParameterKind::kChamberRadius: return &section.chambers.radius;
    case ParameterKind::kAreaGrowth: return &section.chambers.area_growth;
    case ParameterKind::kGentLimit: return &section.material.gent_limit;
    case ParameterKind::kYeohC2: return &section.material.yeoh_c2;
    case ParameterKind::kYeohC3: return &section.material.yeoh_c3;
    case ParameterKind::kPressureStiffening: return &section.material.pressure_stiffening;
    case ParameterKind::kCreepShare: return &section.material.creep_share;
    case ParameterKind::kCreepTime: return &section.material.creep_time;
    default: return nullptr;
  }
}

// Sets the parameter, in all segments. With Young's modulus the shear modulus changes, so that Poisson's ratio stays the
// same. A channel's azimuth rotates all its chambers together about the backbone.
template <class T>
void setParameter(ParametricScene<T>& scene, const SceneParameter& parameter, const T& value) {
  if (parameter.kind == ParameterKind::kTipMass) {
    scene.tip_mass = value;
    return;
  }
  for (auto body = scene.chain.rbegin(); body != scene.chain.rend(); ++body) {
    if (parameter.kind == ParameterKind::kLinkMass) {
      if (body->is_segment) continue;
      body->mass = value;
      return;  // the last link's
    }
    if (!body->is_segment) continue;
    if (parameter.kind == ParameterKind::kChannelAzimuth) {
      for (int chamber : parameter.chambers) body->section.chambers.azimuths[chamber] += value - parameter.start;
      continue;
    }
    T* number = numberOf(*body, parameter.kind);
    if (number == nullptr) return;  // not of the scene
    if (parameter.kind == ParameterKind::kYoungsModulus) body->section.shear_modulus *= value / *number;
    *number = value;
  }
}

}  // namespace live_stiffness
