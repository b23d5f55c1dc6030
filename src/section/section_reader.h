#pragma once
// The keys of a cross-section that every kind of scene file shares.

#include "live_stiffness/section/cross_section.h"
#include "live_stiffness/yaml_map.h"

namespace live_stiffness {

// outer_radius_m and lumen_radius_m (default 0) into `section`.
void readTube(YamlMap& map, CrossSection& section);

// youngs_modulus_pa, poissons_ratio or shear_modulus_pa, shear_correction (default 1), density_kg_m3 (needed under
// gravity only) into `section`.
void readMaterial(YamlMap& map, bool has_gravity, CrossSection& section);

}  // namespace live_stiffness
