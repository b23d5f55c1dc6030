#include "live_stiffness/rod/scene_file.h"

#include <cmath>
#include <set>

#include "section/section_moments.h"
#include "section/section_reader.h"

namespace live_stiffness {
namespace {

constexpr int kMaxChambers = 64;  // per segment
constexpr int kMaxBodies = 256;

Chambers readChambers(YamlMap& map) {
  Chambers chambers;
  for (double azimuth_deg : map.numbers("chamber_azimuths_deg", -1)) chambers.azimuths.push_back(radians(azimuth_deg));
  if (chambers.count() > kMaxChambers)
    map.fault("chamber_azimuths_deg", std::to_string(chambers.count()) + " chambers: must be at most 64");
  // A segment without chambers is a passive one and needs no chamber sizes.
  const bool passive = chambers.azimuths.empty();
  const std::optional<double> otherwise = passive ? std::optional<double>(0.0) : std::nullopt;
  const Range range = passive ? Range::nonnegative() : Range::positive();
  chambers.radius = map.number("chamber_radius_m", range, otherwise);
  chambers.pitch_radius = map.number("chamber_pitch_radius_m", Range::nonnegative(), otherwise);
  return chambers;
}

const char* const kRadii = " (is none of them a diameter?)";

// Faults of a section whose single values are legal but do not fit together.
void checkGeometry(const CrossSection& section, YamlMap& map) {
  const Chambers& chambers = section.chambers;
  const auto text = [](double length) { return numberText(length) + " m"; };
  if (chambers.count() == 0) return;
  if (chambers.pitch_radius + chambers.radius > section.outer_radius)
    map.fault("chamber_pitch_radius_m", text(chambers.pitch_radius) + " puts the chambers through the outer wall: "
              "with chamber_radius_m must be at most outer_radius_m, " + text(section.outer_radius) + kRadii);
  if (chambers.pitch_radius - chambers.radius < section.lumen_radius && section.lumen_radius > 0.0)
    map.fault("chamber_pitch_radius_m", text(chambers.pitch_radius) + " puts the chambers into the lumen: "
              "less chamber_radius_m must be at least lumen_radius_m, " + text(section.lumen_radius) + kRadii);
  if (section.lumen_radius < section.outer_radius && !SectionMoments(section).isValidAt(1.0))
    map.fault("chamber_radius_m", text(chambers.radius) + " leaves no solid area: make the chambers smaller or fewer");
}

Segment readSegment(const YAML::Node& node, const std::string& path, int number, bool has_gravity, FaultList& faults) {
  YamlMap map(node, path, faults);
  Segment segment;
  CrossSection& section = segment.section;
  segment.name = map.text("name", "s" + std::to_string(number));
  segment.length = map.number("length_m", Range::positive());
  readTube(map, section);
  section.chambers = readChambers(map);
  readMaterial(map, has_gravity, section);
  checkGeometry(section, map);
  map.finish();
  return segment;
}

Link readLink(const YAML::Node& node, const std::string& path, FaultList& faults) {
  YamlMap map(node, path, faults);
  Link link;
  link.length = map.number("length_m", Range::nonnegative());
  link.mass = map.number("mass_kg", Range::nonnegative(), 0.0);
  map.finish();
  return link;
}

std::vector<Body> readChain(const YAML::Node& node, bool has_gravity, FaultList& faults) {
  std::vector<Body> chain;
  std::set<std::string> names;
  for (size_t i = 0; i < node.size(); ++i) {
    const std::string path = "chain[" + std::to_string(i) + "]";
    YamlMap body(node[i], path, faults);
    const YAML::Node segment = body.child("segment");
    const YAML::Node link = body.child("link");
    if (segment.IsDefined() == link.IsDefined()) body.fault("must hold exactly one of segment, link");
    else if (segment.IsDefined()) {
      chain.push_back(readSegment(segment, path + ".segment", static_cast<int>(names.size()) + 1, has_gravity, faults));
      const std::string& name = std::get<Segment>(chain.back()).name;
      if (!names.insert(name).second) body.fault("segment", "name " + name + " is taken by an earlier segment");
    } else {
      chain.push_back(readLink(link, path + ".link", faults));
    }
    body.finish();
  }
  if (names.empty()) faults.add("chain: must hold at least one segment" + lineOf(node));
  if (chain.size() > static_cast<size_t>(kMaxBodies))
    faults.add("chain has " + std::to_string(chain.size()) + " bodies: must be at most 256" + lineOf(node));
  return chain;
}

}  // namespace

Scene parseScene(const std::string& yaml, const std::string& name) {
  FaultList faults("scene " + name);
  Scene scene;
  readDocument(yaml, faults, [&](YamlMap& map) {
    if (!isOfKind(map, "serial", "a chain of segments and links", faults)) return;
    if (map.has("gravity_m_s2")) scene.gravity = map.vector("gravity_m_s2");
    else map.child("gravity_m_s2");
    const YAML::Node chain = map.child("chain");
    if (!chain.IsDefined()) map.fault("chain is missing: must be a list of segments and links, base to tip");
    else if (!chain.IsSequence()) map.fault("chain", "must be a list of segments and links, base to tip");
    else scene.chain = readChain(chain, scene.gravity.has_value(), faults);
    const YAML::Node tip = map.child("tip");
    if (tip.IsDefined()) {
      YamlMap tip_map(tip, "tip", faults);
      scene.tip_mass = tip_map.number("mass_kg", Range::nonnegative(), 0.0);
      if (tip_map.has("offset_m")) scene.tip_offset = tip_map.vector("offset_m");
      else tip_map.child("offset_m");
      tip_map.finish();
    }
    map.finish();
  });
  faults.throwIfAny();
  return scene;
}

Scene loadSceneFile(const std::string& path) {
  return parseScene(readTextFile("scene", path), path);
}

}  // namespace live_stiffness
