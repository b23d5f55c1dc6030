#include "live_stiffness/parallel/parallel_scene_file.h"

#include <gtest/gtest.h>

#include "live_stiffness/checks.h"
#include "parallel/parallel_cases.h"
#include "support/matrix_near.h"

namespace live_stiffness {
namespace {

const std::string kSection = "{outer_radius_m: 0.001, youngs_modulus_pa: 2.0e+11, poissons_ratio: 0.3}";
const std::string kPlaces = "base: {radius_m: 0.1, azimuth_deg: 90}, platform: {radius_m: 0.05, azimuth_deg: 180}";

std::string faultsOf(const std::string& yaml) {
  try {
    parseParallelScene(yaml, "test");
  } catch (const ConfigurationError& error) {
    std::string all;
    for (const std::string& fault : error.faults()) all += fault + "\n";
    return all;
  }
  return "none";
}

void expectIn(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

TEST(ParallelSceneFile, LoadsTheStewartGoughRobot) {
  const ParallelScene scene = stewartGough();
  ASSERT_EQ(scene.rodCount(), 6);
  EXPECT_FALSE(scene.gravity.has_value());
  EXPECT_EQ(scene.platform_mass, 0.1);
  EXPECT_EQ(scene.rods[5].section.youngs_modulus, 207e9);
  EXPECT_DOUBLE_EQ(scene.rods[0].section.shear_modulus, 207e9 / 2.6);
  const double a = radians(-4.0), b = radians(-56.0);
  EXPECT_TRUE(matrixNear(scene.rods[0].X_BD.p, 0.073 * Vector3(std::cos(a), std::sin(a), 0.0), 1e-16));
  EXPECT_TRUE(matrixNear(scene.rods[0].X_PE.p, 0.073 * Vector3(std::cos(b), std::sin(b), 0.0), 1e-16));
}

TEST(ParallelSceneFile, TakesHeightsAxesAndSectionsOfSingleRods) {
  const ParallelScene scene = parseParallelScene(
      "kind: parallel\nrod_section: " + kSection + "\nrods:\n"
      "  - {base: {radius_m: 0.1, azimuth_deg: 90, height_m: 0.02, axis: [1, 0, 1]}, "
      "platform: {radius_m: 0.05, azimuth_deg: 180}}\n"
      "  - {" + kPlaces + ", section: {outer_radius_m: 0.002, lumen_radius_m: 0.001, youngs_modulus_pa: 1.0e+11, "
      "shear_modulus_pa: 4.0e+10}}\n", "test");
  ASSERT_EQ(scene.rodCount(), 2);
  EXPECT_TRUE(matrixNear(scene.rods[0].X_BD.p, Vector3(0.0, 0.1, 0.02), 1e-16));
  EXPECT_TRUE(matrixNear(scene.rods[0].X_BD.R.col(2), Vector3(1.0, 0.0, 1.0).normalized(), 1e-15));
  EXPECT_EQ(scene.rods[0].section.outer_radius, 0.001);
  EXPECT_EQ(scene.rods[1].section.lumen_radius, 0.001);
  EXPECT_EQ(scene.rods[1].section.shear_modulus, 4e10);
  EXPECT_EQ(scene.platform_mass, 0.0);
}

TEST(ParallelSceneFile, TakesMergeKeys) {
  const ParallelScene scene = parseParallelScene(
      "kind: parallel\nrod_section: " + kSection + "\nhole: &hole {radius_m: 0.1, height_m: 0.02}\nrods:\n"
      "  - {base: {<<: *hole, azimuth_deg: 90}, platform: {azimuth_deg: 180, radius_m: 0.05, <<: *hole}}\n", "test");
  ASSERT_EQ(scene.rodCount(), 1);
  EXPECT_TRUE(matrixNear(scene.rods[0].X_BD.p, Vector3(0.0, 0.1, 0.02), 1e-16));
  EXPECT_TRUE(matrixNear(scene.rods[0].X_PE.p, Vector3(-0.05, 0.0, 0.02), 1e-16));
}

TEST(ParallelSceneFile, ListsAllFaults) {
  expectIn(faultsOf("kind: parallel\n"), {"rods is missing"});
  expectIn(faultsOf("kind: parallel\nrods: []\n"), {"at least one rod"});
  expectIn(faultsOf("chain: []\n"), {"kind = serial: must be parallel here", "stiffness_solve"});
  expectIn(faultsOf("kind: parallel\nrods:\n  - {" + kPlaces + "}\n"), {"rods[0]: section is missing"});
  expectIn(faultsOf("kind: parallel\ngravity_m_s2: [0, 0, -9.81]\nrod_section: " + kSection +
                    "\nrods:\n  - {base: {radius_m: -1, azimuth_deg: x, axis: [0, 0, 0]}, colour: red}\n"
                    "platform: {mass_kg: -1}\n"),
           {"rod_section.density_kg_m3 is missing", "rods[0].base.radius_m = -1: must be >= 0",
            "rods[0].base.azimuth_deg = x: must be a number", "rods[0].base.axis: must be a direction",
            "rods[0]: platform is missing", "rods[0].colour: unknown key", "platform.mass_kg = -1", "(line 5)"});
  expectIn(faultsOf("kind: parallel\nrods: [\n"), {"not YAML"});
  EXPECT_THROW(loadParallelSceneFile("/nonexistent.yaml"), ConfigurationError);
}

}  // namespace
}  // namespace live_stiffness
