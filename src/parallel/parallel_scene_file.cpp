#include "live_stiffness/parallel/parallel_scene_file.h"

#include <cmath>

#include "section/section_reader.h"

namespace live_stiffness {
namespace {

constexpr size_t kMaxRods = 64;

// A place on a hole pattern: on a circle about z, at a height, with the direction of the rod there.
Pose readPlace(YamlMap& rod, const std::string& key, const std::string& path, FaultList& faults) {
  const YAML::Node node = rod.child(key);
  if (!node.IsDefined()) {
    rod.fault(key + " is missing: must be a mapping of radius_m, azimuth_deg and optionally height_m, axis");
    return {};
  }
  YamlMap map(node, path + "." + key, faults);
  Pose place;
  const double radius = map.number("radius_m", Range::nonnegative());
  const double azimuth = radians(map.number("azimuth_deg", Range::finite()));
  place.p = {radius * std::cos(azimuth), radius * std::sin(azimuth), map.number("height_m", Range::finite(), 0.0)};
  if (map.has("axis")) {
    const Vector3 axis = map.vector("axis");
    // The smallest rotation that takes z to the axis; half a turn about x for -z.
    if (axis.norm() > 0.0) place.R = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix();
    else map.fault("axis", "must be a direction from base to platform, not zero");
  }
  map.finish();
  return place;
}

CrossSection readRodSection(const YAML::Node& node, const std::string& path, bool has_gravity, FaultList& faults) {
  YamlMap map(node, path, faults);
  CrossSection section;
  readTube(map, section);
  readMaterial(map, has_gravity, section);
  map.finish();
  return section;
}

std::vector<ParallelRod> readRods(const YAML::Node& node, const std::optional<CrossSection>& shared, bool has_gravity,
                                  FaultList& faults) {
  std::vector<ParallelRod> rods;
  if (node.size() == 0) faults.add("rods: must hold at least one rod" + lineOf(node));
  if (node.size() > kMaxRods)
    faults.add("rods has " + std::to_string(node.size()) + " rods: must be at most 64" + lineOf(node));
  for (size_t i = 0; i < node.size() && i < kMaxRods; ++i) {
    const std::string path = "rods[" + std::to_string(i) + "]";
    YamlMap map(node[i], path, faults);
    ParallelRod rod;
    rod.X_BD = readPlace(map, "base", path, faults);
    rod.X_PE = readPlace(map, "platform", path, faults);
    const YAML::Node own = map.child("section");
    if (own.IsDefined()) rod.section = readRodSection(own, path + ".section", has_gravity, faults);
    else if (shared) rod.section = *shared;
    else map.fault("section is missing: give it here, or once for all rods as rod_section");
    map.finish();
    rods.push_back(rod);
  }
  return rods;
}

}  // namespace

ParallelScene parseParallelScene(const std::string& yaml, const std::string& name) {
  FaultList faults("scene " + name);
  ParallelScene scene;
  readDocument(yaml, faults, [&](YamlMap& map) {
    if (!isOfKind(map, "parallel", "rods between a base and a platform", faults)) return;
    if (map.has("gravity_m_s2")) scene.gravity = map.vector("gravity_m_s2");
    const bool has_gravity = scene.gravity.has_value();
    std::optional<CrossSection> shared;
    const YAML::Node section = map.child("rod_section");
    if (section.IsDefined()) shared = readRodSection(section, "rod_section", has_gravity, faults);
    const YAML::Node rods = map.child("rods");
    if (!rods.IsDefined()) map.fault("rods is missing: must be a list of rods");
    else if (!rods.IsSequence()) map.fault("rods", "must be a list of rods");
    else scene.rods = readRods(rods, shared, has_gravity, faults);
    const YAML::Node platform = map.child("platform");
    if (platform.IsDefined()) {
      YamlMap platform_map(platform, "platform", faults);
      scene.platform_mass = platform_map.number("mass_kg", Range::nonnegative(), 0.0);
      if (platform_map.has("centre_of_mass_m")) scene.platform_centre = platform_map.vector("centre_of_mass_m");
      platform_map.finish();
    }
    map.finish();
  });
  faults.throwIfAny();
  return scene;
}

ParallelScene loadParallelSceneFile(const std::string& path) {
  return parseParallelScene(readTextFile("scene", path), path);
}

}  // namespace live_stiffness
