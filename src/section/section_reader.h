#pragma once
// The keys of a cross-section that every kind of scene file shares.

#include "live_stiffness/section/cross_section.h"
#include "yaml_map.h"

namespace live_stiffness {

// What a scene may say, and a calibration may find.
inline constexpr Range kAreaGrowthRange{-4.9e-6, 4.9e-6};  // 1/Pa; just below 1 / (2 atm), see Chambers::area_growth
inline constexpr Range kPressureStiffeningRange{0.0, 10.0};
inline constexpr Range kCreepShareRange{0.0, 0.9};

// outer_radius_m and lumen_radius_m (default 0) into `section`.
void readTube(YamlMap& map, CrossSection& section);

// youngs_modulus_pa, poissons_ratio or shear_modulus_pa, shear_correction (default 1), density_kg_m3 (needed under
// gravity only) into `section`. Where it has chambers, also what pressure and stretch do to them and to the material:
// stretch_law (section_update by default, neo_hookean, gent with gent_limit, yeoh with yeoh_c2 and yeoh_c3),
// chamber_area_growth_per_pa, pressure_stiffening, creep_share and creep_time_s; see material.h and chambers.h.
void readMaterial(YamlMap& map, bool has_gravity, CrossSection& section);

}  // namespace live_stiffness
