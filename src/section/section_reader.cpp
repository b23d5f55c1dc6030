#include "section/section_reader.h"

#include <cmath>

namespace live_stiffness {
namespace {

double readShearModulus(YamlMap& map, double youngs_modulus) {
  const bool has_ratio = map.has("poissons_ratio");
  const bool has_modulus = map.has("shear_modulus_pa");
  if (has_ratio && has_modulus) map.fault("shear_modulus_pa", "give either this or poissons_ratio, not both");
  if (has_modulus) {
    if (has_ratio) map.number("poissons_ratio", Range::finite());
    return map.number("shear_modulus_pa", Range::positive());
  }
  if (!has_ratio) map.fault("poissons_ratio or shear_modulus_pa is missing");
  return youngs_modulus / (2.0 * (1.0 + map.number("poissons_ratio", {-1.0, 0.5, true, false}, std::nan(""))));
}

// Only the numbers of the law chosen are asked for, so that one without its law is refused as an unknown key.
void readStretchLaw(YamlMap& map, Material& material) {
  const std::string law = map.text("stretch_law", "section_update");
  if (law == "gent") {
    material.law = StretchLaw::kGent;
    material.gent_limit = map.number("gent_limit", Range::positive());
  } else if (law == "yeoh") {
    material.law = StretchLaw::kYeoh;
    material.yeoh_c2 = map.number("yeoh_c2", Range::finite());
    material.yeoh_c3 = map.number("yeoh_c3", Range::finite(), 0.0);
  } else if (law == "neo_hookean") {
    material.law = StretchLaw::kNeoHookean;
  } else if (law != "section_update") {
    map.fault("stretch_law", "'" + law + "': must be section_update, neo_hookean, gent or yeoh");
  }
}

void readPressurised(YamlMap& map, CrossSection& section) {
  readStretchLaw(map, section.material);
  section.chambers.area_growth =
      map.number("chamber_area_growth_per_pa", kAreaGrowthRange, 0.0);
  section.material.pressure_stiffening = map.number("pressure_stiffening", kPressureStiffeningRange, 0.0);
  section.material.creep_share = map.number("creep_share", kCreepShareRange, 0.0);
  section.material.creep_time = map.number("creep_time_s", Range::positive(), 1.0);
}

}  // namespace

void readTube(YamlMap& map, CrossSection& section) {
  section.outer_radius = map.number("outer_radius_m", Range::positive());
  section.lumen_radius = map.number("lumen_radius_m", Range::nonnegative(), 0.0);
  if (section.lumen_radius >= section.outer_radius)
    map.fault("lumen_radius_m", numberText(section.lumen_radius) + " m must be below outer_radius_m, " +
                                    numberText(section.outer_radius) + " m");
}

void readMaterial(YamlMap& map, bool has_gravity, CrossSection& section) {
  section.youngs_modulus = map.number("youngs_modulus_pa", Range::positive());
  section.shear_modulus = readShearModulus(map, section.youngs_modulus);
  section.shear_correction = map.number("shear_correction", Range::positive(), 1.0);
  // Without chambers nothing stretches a segment, so that none of this has an effect.
  if (section.chambers.count() > 0) readPressurised(map, section);
  // Without gravity mass has no effect, so it need not be known.
  section.density = map.number("density_kg_m3", Range::nonnegative(),
                               has_gravity ? std::nullopt : std::optional<double>(0.0));
}

}  // namespace live_stiffness
