#include "calibration/scene_text.h"

#include <iomanip>
#include <locale>
#include <sstream>

#include "csv_table.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/rod/scene_file.h"
#include "part_file.h"

namespace live_stiffness {
namespace {

// The shortest of 6 to 17 digits that reads back to the same number.
std::string exact(double value) {
  for (int digits = 6; digits <= 17; ++digits) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::setprecision(digits) << value;
    if (finiteNumber(text.str()) == value) return text.str();
  }
  return numberText(value);
}

std::string list(const Vector3& v) { return "[" + exact(v.x()) + ", " + exact(v.y()) + ", " + exact(v.z()) + "]"; }

// In quotes, so that it may hold what YAML has a use for, such as # or a colon.
std::string quoted(const std::string& text) {
  std::string quotes = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quotes += std::string("\\") + c;
    else if (code >= ' ' && code != 127) quotes += c;
    else quotes += std::string("\\x") + "0123456789abcdef"[code / 16] + "0123456789abcdef"[code % 16];
  }
  return quotes + "\"";
}

void writeSegment(std::ostream& out, const Segment& segment) {
  const CrossSection& section = segment.section;
  const auto line = [&](const std::string& key, const std::string& value) {
    out << "      " << key << ": " << value << "\n";
  };
  out << "  - segment:\n";
  line("name", quoted(segment.name));
  line("length_m", exact(segment.length));
  line("outer_radius_m", exact(section.outer_radius));
  line("lumen_radius_m", exact(section.lumen_radius));
  std::string azimuths;
  for (double azimuth : section.chambers.azimuths) azimuths += (azimuths.empty() ? "" : ", ") + exact(degrees(azimuth));
  line("chamber_azimuths_deg", "[" + azimuths + "]");
  if (section.chambers.count() > 0) {
    line("chamber_radius_m", exact(section.chambers.radius));
    line("chamber_pitch_radius_m", exact(section.chambers.pitch_radius));
    if (section.chambers.area_growth != 0.0) line("chamber_area_growth_per_pa", exact(section.chambers.area_growth));
  }
  line("youngs_modulus_pa", exact(section.youngs_modulus));
  line("shear_modulus_pa", exact(section.shear_modulus));
  line("shear_correction", exact(section.shear_correction));
  line("density_kg_m3", exact(section.density));
  if (section.chambers.count() == 0) return;
  const Material& material = section.material;
  if (material.law == StretchLaw::kNeoHookean) line("stretch_law", "neo_hookean");
  if (material.law == StretchLaw::kGent) {
    line("stretch_law", "gent");
    line("gent_limit", exact(material.gent_limit));
  }
  if (material.law == StretchLaw::kYeoh) {
    line("stretch_law", "yeoh");
    line("yeoh_c2", exact(material.yeoh_c2));
    line("yeoh_c3", exact(material.yeoh_c3));
  }
  if (material.pressure_stiffening != 0.0) line("pressure_stiffening", exact(material.pressure_stiffening));
  if (material.creep_share != 0.0) {
    line("creep_share", exact(material.creep_share));
    line("creep_time_s", exact(material.creep_time));
  }
}

}  // namespace

std::string sceneText(const Scene& scene, const std::string& comment) {
  std::ostringstream out;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) out << "# " << line << "\n";
  if (scene.gravity) out << "gravity_m_s2: " << list(*scene.gravity) << "\n";
  out << "chain:\n";
  for (const Body& body : scene.chain) {
    if (const auto* segment = std::get_if<Segment>(&body)) writeSegment(out, *segment);
    else
      out << "  - link: {length_m: " << exact(std::get<Link>(body).length)
          << ", mass_kg: " << exact(std::get<Link>(body).mass) << "}\n";
  }
  out << "tip: {mass_kg: " << exact(scene.tip_mass) << ", offset_m: " << list(scene.tip_offset) << "}\n";
  return out.str();
}

void saveSceneFile(const std::string& path, const Scene& scene, const std::string& comment) {
  const std::string text = sceneText(scene, comment);
  try {
    parseScene(text, path);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError("scene " + path + " is not written, since it could not be read again", error.faults());
  }
  writeTextFile("scene", path, text);
}

}  // namespace live_stiffness
