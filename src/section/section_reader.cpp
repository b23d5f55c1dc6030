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
  // Without gravity mass has no effect, so it need not be known.
  section.density = map.number("density_kg_m3", Range::nonnegative(),
                               has_gravity ? std::nullopt : std::optional<double>(0.0));
}

}  // namespace live_stiffness
