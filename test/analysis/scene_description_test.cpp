#include "analysis/scene_description.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "live_stiffness/checks.h"
#include "live_stiffness/rod/scene_file.h"
#include "support/decimal_comma.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

// docs/tutorial.md's arm.
std::string tutorialText() {
  const std::string page = readTextFile("page", std::string(SOURCE_DIR) + "/docs/tutorial.md"), start = "# my_arm.yaml";
  const size_t begin = page.find(start);
  return page.substr(begin, page.find("```", begin) - begin);
}

// The same with a part of its text replaced.
Scene tutorialWith(const std::vector<std::pair<std::string, std::string>>& changes) {
  std::string text = tutorialText();
  for (const auto& [from, to] : changes) {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  return parseScene(text, "test");
}

std::string doubtsWith(const std::vector<std::pair<std::string, std::string>>& changes) {
  return oneLine(doubtsAbout(tutorialWith(changes)));
}

TEST(SceneDoubts, AreNoneAboutShippedScenes) {
  int scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::string(SOURCE_DIR) + "/config/scenes")) {
    if (readTextFile("scene", file.path()).find("kind: parallel") != std::string::npos) continue;
    EXPECT_EQ(oneLine(doubtsAbout(loadSceneFile(file.path()))), "") << file.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 7);
  EXPECT_EQ(doubtsWith({}), "");
  for (const char* law : {"neo_hookean", "gent\n      gent_limit: 5.0", "yeoh\n      yeoh_c2: 0.1"})
    EXPECT_EQ(doubtsWith({{"      density", "      stretch_law: " + std::string(law) + "\n      density"}}), "") << law;
  EXPECT_EQ(oneLine(doubtsAbout(awkwardScene())), "");
}

// Each slip alone raises its doubt, with the way out, and no other one.
TEST(SceneDoubts, NameTheUsualSlips) {
  const struct {
    std::vector<std::pair<std::string, std::string>> changes;
    std::vector<std::string> parts;
  } slips[] = {
      {{{"outer_radius_m: 0.015", "outer_radius_m: 0.030"}}, {"outer_radius_m = 0.03", "diameter, write 0.015"}},
      {{{"outer_radius_m: 0.015", "outer_radius_m: 0.030"}, {"lumen_radius_m: 0.005", "lumen_radius_m: 0.010"},
        {"chamber_radius_m: 0.003", "chamber_radius_m: 0.006"}, {"pitch_radius_m: 0.010", "pitch_radius_m: 0.020"}},
       {"outer_radius_m = 0.03", "diameters, halve them"}},
      {{{"lumen_radius_m: 0.005", "lumen_radius_m: 0.0"}, {"chamber_radius_m: 0.003", "chamber_radius_m: 0.005"}},
       {"chamber_radius_m = 0.005", "diameter, write 0.0025"}},
      {{{"[0.0, 120.0, 240.0]", "[0, 2.094, 4.189]"}}, {"up to 4.189 deg", "radians", "240"}},
      {{{"[0.0, 120.0, 240.0]", "[0, 3.1416]"}}, {"radians", "180"}},
      {{{"[0.0, 120.0, 240.0]", "[1.5708]"}}, {"radians", "90"}},
      {{{"[0.0, 120.0, 240.0]", "[0, 20, 240]"}}, {"chambers 1 and 2 overlap", "3.47296 mm"}},
      {{{"[0.0, 120.0, 240.0]", "[0, 120, 120]"}}, {"2 of 3 chambers are in one place"}},
      {{{"[0.0, 120.0, 240.0]", "[0, 120, 240, 1, 121, 242, 2]"}}, {"3 of 7 chambers are in one place"}},
      {{{"length_m: 0.060", "length_m: 60"}}, {"segment s1: length_m = 60", "write 0.06,"}},
      {{{"length_m: 0.060", "length_m: 6"}}, {"length_m = 6", "if in cm, 0.06"}},
      {{{"length_m: 0.012", "length_m: 12"}}, {"link 1: length_m = 12", "write 0.012"}},
      {{{"outer_radius_m: 0.015", "outer_radius_m: 15"}}, {"outer_radius_m = 15", "write 0.015"}},
      {{{"0.0, 0.0, 0.008", "0, 0, 8"}}, {"tip: offset_m: 8 m", "mm"}},
      {{{"mass_kg: 0.010", "mass_kg: 10"}}, {"link 1: mass_kg = 10", "in g, write 0.01"}},
      {{{"mass_kg: 0.015", "mass_kg: 1"}}, {"tip: mass_kg = 1: 28.6595 times", "write 0.001"}},
      {{{"120.0e3", "120"}}, {"youngs_modulus_pa = 120", "kPa, write 120000"}},
      {{{"120.0e3", "0.12"}}, {"youngs_modulus_pa = 0.12", "MPa, write 120000"}},
      {{{"120.0e3", "5.1e9"}}, {"youngs_modulus_pa = 5.1e+09", "5 GPa"}},
      {{{"poissons_ratio: 0.5", "shear_modulus_pa: 40"}}, {"shear_modulus_pa = 40", "3000 times"}},
      {{{"1070.0", "1.08"}}, {"density_kg_m3 = 1.08", "write 1080"}},
      {{{"1070.0", "1.08e6"}}, {"density_kg_m3 = 1.08e+06", "write 1080"}},
      {{{"-9.81", "-9810"}}, {"9810 m/s2", "mm/s2"}},
      {{{"-9.81", "-1"}}, {"1 m/s2", "multiply it by 9.81"}},
      {{{"mass_kg: 0.015", "mass_kg: 0.6"}, {"120.0e3", "6.0e3"}}, {"would strain it by", "youngs_modulus_pa = 6000"}},
  };
  for (const auto& slip : slips) {
    const std::vector<std::string> doubts = doubtsAbout(tutorialWith(slip.changes));
    ASSERT_EQ(doubts.size(), 1u) << slip.changes[0].second << ": " << oneLine(doubts);
    for (const std::string& part : slip.parts) EXPECT_NE(doubts[0].find(part), std::string::npos) << part << "\n" << doubts[0];
  }
}

TEST(SceneDoubts, AreSaidOnceWhereSegmentsShareThem) {
  Scene scene = paperScene(2);
  for (int k : {0, 1}) segmentOf(scene, k).section.youngs_modulus = segmentOf(scene, k).section.shear_modulus = 90.0;
  const std::vector<std::string> doubts = doubtsAbout(scene);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].rfind("segment s1 and 1 more: youngs_modulus_pa = 90: ", 0), 0u) << doubts[0];
}

TEST(SceneDoubts, AreNoneWhereItMayWellBeMeant) {
  EXPECT_EQ(doubtsWith({{"-9.81", "9.81"}}), "");                        // hanging
  EXPECT_EQ(doubtsWith({{"-9.81", "-1.62"}}), "");                       // on the Moon
  EXPECT_EQ(doubtsWith({{"[0.0, 120.0, 240.0]", "[-2.5, 2.5]"}}).find("radians"), std::string::npos);
  EXPECT_EQ(doubtsWith({{"[0.0, 120.0, 240.0]", "[0, 5, 120, 125, 240, 245]"}}), "");  // pairs for larger chambers
  EXPECT_EQ(doubtsWith({{"[0.0, 120.0, 240.0]", "[0]"}}), "");
  EXPECT_EQ(doubtsWith({{"[0.0, 120.0, 240.0]", "[]"}, {"length_m: 0.060", "length_m: 0.02"}}), "");  // a passive disc
  EXPECT_EQ(doubtsWith({{"120.0e3", "5.0e9"}}), "");
  EXPECT_EQ(doubtsAbout(Scene()).size(), 0u);
}

testing::AssertionResult holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos ? testing::AssertionSuccess()
                                              : testing::AssertionFailure() << "no \"" << part << "\" in\n" << text;
}

TEST(SceneDescription, SaysWhatTheTutorialsArmIs) {
  const std::string text = describeScene(tutorialWith({}));
  EXPECT_TRUE(holds(text, "lengths     72 mm: s1 60, link 12; tip point (0.00, 0.00, 8.00) mm from the end\n"));
  EXPECT_TRUE(holds(text, "masses      59.8924 g: s1 34.8924, link 10, tip 15\n"));
  EXPECT_TRUE(holds(text, "9.81 m/s2, along -z of the base: the arm stands\n"));
  EXPECT_TRUE(holds(text, "chamber 1   (s1, azimuth 0 deg) bends by 30.2 deg towards -x; the tip moves by 27.1"));
  EXPECT_TRUE(holds(text, "towards 30 deg from -y to +x"));  // chamber 2, at 120 deg
  EXPECT_TRUE(holds(text, "No doubts.\n"));
  const DecimalComma comma;
  EXPECT_EQ(describeScene(tutorialWith({})), text);
}

TEST(SceneDescription, SaysWhereGravityPulls) {
  const auto gravity = [](const std::string& vector) { return describeScene(tutorialWith({{"[0.0, 0.0, -9.81]", vector}})); };
  EXPECT_TRUE(holds(gravity("[0, 0, 9.81]"), "the arm hangs\nbuckling    none"));
  EXPECT_TRUE(holds(gravity("[0, 9.81, 0]"), "to +y of the base: the arm is held out sideways\nbuckling    none"));
  EXPECT_TRUE(holds(gravity("[6.94, 0, -6.94]"), "135.0 deg from +z of the base, to +x: the arm stands at an angle"));
  EXPECT_TRUE(holds(gravity("[0, 0, 0]"), "none: masses do not matter\nbuckling    none"));
}

// Euler's column under a tip load, of a slender arm: P = pi^2 E I / (4 L^2).
TEST(SceneDescription, KnowsTheMarginToBuckling) {
  const auto described = [](double weights) {
    Scene scene = parseScene("gravity_m_s2: [0, 0, -10]\nchain:\n  - segment: {length_m: 0.5, outer_radius_m: 0.01, "
                             "chamber_azimuths_deg: [], youngs_modulus_pa: 1.0e6, poissons_ratio: 0.5, "
                             "density_kg_m3: 0}\n", "test");
    const double euler = std::pow(kPi, 3) * 1e6 * 1e-8 / 16.0 / (0.5 * 0.5);  // N
    scene.tip_mass = euler / 10.0 / weights;
    return describeScene(scene);
  };
  EXPECT_TRUE(holds(described(4.0), "buckles at about 4.0"));
  const std::string weak = described(0.5);
  EXPECT_TRUE(holds(weak, "buckles at about 0.50 times the weight along its axis: IT CANNOT STAND"));
  EXPECT_TRUE(holds(weak, "at rest     "));
}

// 1 bar coils up a section this soft, or is more than it has an equilibrium for.
TEST(SceneDescription, TakesLessPressureWhereOneBarIsTooMuch) {
  const std::string soft = describeScene(tutorialWith({{"-9.81", "9.81"}, {"120.0e3", "12.0e3"}}));
  EXPECT_TRUE(holds(soft, "azimuth 0 deg) coils up by "));
  EXPECT_TRUE(holds(soft, " at 1 bar; at 0.5 bar bends by 50.1 deg towards -x; "));
  const std::string softer = describeScene(tutorialWith({{"-9.81", "9.81"}, {"120.0e3", "4.0e3"}}));
  EXPECT_TRUE(holds(softer, "azimuth 0 deg) out_of_range at 1 bar; at 0."));
}

}  // namespace
}  // namespace live_stiffness
