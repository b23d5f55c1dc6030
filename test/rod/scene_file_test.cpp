#include "live_stiffness/rod/scene_file.h"

#include <gtest/gtest.h>

#include "live_stiffness/checks.h"
#include "support/decimal_comma.h"
#include "support/matrix_near.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

const std::string kSegment =
    "{length_m: 0.04, outer_radius_m: 0.0125, chamber_radius_m: 0.002, chamber_pitch_radius_m: 0.008, "
    "chamber_azimuths_deg: [0, 90, 180, 270], youngs_modulus_pa: 90000, poissons_ratio: 0.5}";

std::string chainOf(const std::string& bodies) { return "chain:\n" + bodies; }
std::string segmentWith(const std::string& extra) {
  return kSegment.substr(0, kSegment.size() - 1) + ", " + extra + "}";
}

// All faults of a text, one a line; "none" if it loads.
std::string faultsOf(const std::string& yaml) {
  try {
    parseScene(yaml, "test");
  } catch (const ConfigurationError& error) {
    std::string all;
    for (const std::string& fault : error.faults()) all += fault + "\n";
    return all;
  }
  return "none";
}

testing::AssertionResult holds(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    if (text.find(part) == std::string::npos)
      return testing::AssertionFailure() << "no \"" << part << "\" in:\n" << text;
  return testing::AssertionSuccess();
}

TEST(SceneFile, LoadsThePapersScenes) {
  Scene one = paperScene(1);
  EXPECT_EQ(one.segmentCount(), 1);
  EXPECT_EQ(one.chamberCount(), 6);
  EXPECT_TRUE(matrixNear(one.gravity.value(), Vector3(0.0, 0.0, -9.81), 0.0));
  EXPECT_EQ(one.tip_mass, 0.0105);
  const Segment& segment = segmentOf(one, 0);
  EXPECT_EQ(segment.name, "s1");
  EXPECT_EQ(segment.length, 0.040);
  EXPECT_EQ(segment.section.outer_radius, 0.0125);
  EXPECT_EQ(segment.section.lumen_radius, 0.0044);
  EXPECT_EQ(segment.section.chambers.radius, 0.00225);
  EXPECT_EQ(segment.section.chambers.pitch_radius, 0.00831);
  EXPECT_DOUBLE_EQ(segment.section.chambers.azimuths[2], radians(117.5));
  EXPECT_EQ(segment.section.youngs_modulus, 90060.0);
  EXPECT_DOUBLE_EQ(segment.section.shear_modulus, 30020.0);
  EXPECT_EQ(segment.section.shear_correction, 1.2421);
  EXPECT_EQ(segment.section.density, 1070.0);

  const Scene two = paperScene(2);
  EXPECT_EQ(two.segmentCount(), 2);
  EXPECT_EQ(two.chamberCount(), 12);
  EXPECT_DOUBLE_EQ(two.length(), 0.086);
  EXPECT_EQ(std::get<Link>(two.chain[1]).length, 0.006);
}

TEST(SceneFile, TakesItsDefaults) {
  Scene scene = parseScene(chainOf("  - segment: " + kSegment), "test");
  EXPECT_FALSE(scene.gravity.has_value());
  EXPECT_FALSE(scene.hasWeight());
  EXPECT_EQ(scene.tip_mass, 0.0);
  EXPECT_TRUE(matrixNear(scene.tip_offset, Vector3::Zero(), 0.0));
  EXPECT_EQ(segmentOf(scene, 0).section.shear_correction, 1.0);
  EXPECT_EQ(segmentOf(scene, 0).section.lumen_radius, 0.0);
  EXPECT_EQ(segmentOf(scene, 0).name, "s1");
}

TEST(SceneFile, IsRefusedIfOfAnotherKind) {
  const std::string chain = chainOf("  - segment: " + kSegment + "\n");
  EXPECT_EQ(faultsOf("kind: serial\n" + chain), "none");
  EXPECT_TRUE(holds(faultsOf("kind: parallel\nrods: []\n"), {"kind = parallel: must be serial here", "parallel_solve"}));
  EXPECT_TRUE(holds(faultsOf("kind: delta\n" + chain), {"kind = delta: must be serial here"}));
}

TEST(SceneFile, MixesSegmentsAndLinksFreely) {
  const std::string link = "  - link: {length_m: 0.006}\n", segment = "  - segment: " + kSegment + "\n";
  const Scene scene = parseScene(chainOf(link + link + segment + segment + link + segment + link), "test");
  EXPECT_EQ(scene.chain.size(), 7u);
  EXPECT_EQ(scene.segmentCount(), 3);
  EXPECT_EQ(scene.chamberCount(), 12);
  EXPECT_DOUBLE_EQ(scene.length(), 3 * 0.04 + 4 * 0.006);
  EXPECT_TRUE(solveCold(StiffnessModel(scene, {}), Pressures::Constant(12, 2e4)).status.ok());
}

TEST(SceneFile, TakesAShearModulusInsteadOfPoissonsRatio) {
  std::string text = kSegment;
  text.replace(text.find("poissons_ratio: 0.5"), 19, "shear_modulus_pa: 31000");
  Scene scene = parseScene(chainOf("  - segment: " + text), "test");
  EXPECT_EQ(segmentOf(scene, 0).section.shear_modulus, 31000.0);
}

TEST(SceneFile, RefusesBothPoissonsRatioAndShearModulus) {
  EXPECT_TRUE(holds(faultsOf(chainOf("  - segment: " + segmentWith("shear_modulus_pa: 30000"))),
                    {"chain[0].segment.shear_modulus_pa", "not both", "(line 2)"}));
}

TEST(SceneFile, ReportsEveryFaultWithKeyValueRangeAndLine) {
  const std::string faults = faultsOf(R"(gravity_m_s2: [0, 0]
chain:
  - segment:
      length_m: -0.04
      outer_radius_m: wide
      lumen_radius_m: .nan
      chamber_radius_m: 0.002
      chamber_azimuths_deg: [0, x]
      youngs_modulus_pa: 0
      poissons_ratio: 0.7
      density_kg_m3: 1070
      colour: blue
  - link: {length_m: 0.006, length_m: 0.007}
  - joint: {}
tip: {mass_kg: -1}
wind: 3
)");
  EXPECT_TRUE(holds(faults, {
      "gravity_m_s2 is 2 entries: must be a list of 3 finite numbers (line 1)",
      "chain[0].segment.length_m = -0.04: must be > 0 (line 4)",
      "chain[0].segment.outer_radius_m = wide: must be a number, > 0 (line 5)",
      "chain[0].segment.lumen_radius_m = .nan: must be a number, >= 0 (line 6)",
      "chain[0].segment.chamber_pitch_radius_m is missing: must be a number, >= 0 (line 4)",
      "chain[0].segment.chamber_azimuths_deg[1] = x: must be a number, any finite number (line 8)",
      "chain[0].segment.youngs_modulus_pa = 0: must be > 0 (line 9)",
      "chain[0].segment.poissons_ratio = 0.7: must be > -1 and <= 0.5 (line 10)",
      "chain[0].segment.colour: unknown key; known here: ",
      "chain[1].link.length_m: is given more than once (line 13)",
      "chain[2]: must hold exactly one of segment, link (line 14)",
      "chain[2].joint: unknown key; known here: link, segment (line 14)",
      "tip.mass_kg = -1: must be >= 0 (line 15)",
      "wind: unknown key; known here: chain, gravity_m_s2, kind, tip (line 16)",
  }));
}

TEST(SceneFile, NamesTheFileAndCountsTheFaultsInItsMessage) {
  try {
    parseScene("chain: []\nwind: 1", "robot.yaml");
    FAIL() << "loaded";
  } catch (const ConfigurationError& error) {
    EXPECT_TRUE(holds(error.what(), {"scene robot.yaml: 2 faults", "\n  - chain: must hold at least one segment"}));
  }
}

TEST(SceneFile, RefusesMissingKeys) {
  EXPECT_TRUE(holds(faultsOf(chainOf("  - segment: {name: s1}")),
                    {"length_m is missing", "outer_radius_m is missing", "chamber_azimuths_deg is missing",
                     "youngs_modulus_pa is missing", "poissons_ratio or shear_modulus_pa is missing"}));
  EXPECT_TRUE(holds(faultsOf("tip: {mass_kg: 0.01}"), {"chain is missing"}));
}

TEST(SceneFile, NeedsDensityOnlyWithGravity) {
  const std::string chain = chainOf("  - segment: " + kSegment);
  EXPECT_EQ(faultsOf(chain), "none");
  EXPECT_TRUE(holds(faultsOf("gravity_m_s2: [0, 0, -9.81]\n" + chain), {"density_kg_m3 is missing"}));
}

TEST(SceneFile, RefusesGeometryThatDoesNotFit) {
  const auto faults = [](const std::string& key, const std::string& value) {
    std::string text = segmentWith("lumen_radius_m: 0.004");
    const size_t at = text.find(key + ":") + key.size() + 2;
    text.replace(at, text.find_first_of(",}", at) - at, value);
    return faultsOf(chainOf("  - segment: " + text));
  };
  EXPECT_TRUE(holds(faults("lumen_radius_m", "0.02"), {"lumen_radius_m: 0.02 m must be below outer_radius_m, 0.0125"}));
  EXPECT_TRUE(holds(faults("chamber_pitch_radius_m", "0.0115"), {"through the outer wall", "0.0115"}));
  EXPECT_TRUE(holds(faults("chamber_pitch_radius_m", "0.005"), {"into the lumen", "0.005"}));
}

TEST(SceneFile, RefusesDuplicateNames) {
  const std::string segment = "  - segment: " + segmentWith("name: arm") + "\n";
  EXPECT_TRUE(holds(faultsOf(chainOf(segment + segment)), {"name arm is taken by an earlier segment", "(line 3)"}));
}

TEST(SceneFile, RefusesWhatIsNotYamlOrNotAScene) {
  EXPECT_TRUE(holds(faultsOf("chain: [\n  - {"), {"not YAML: ", "(line "}));
  EXPECT_TRUE(holds(faultsOf(""), {"must be a mapping"}));
  EXPECT_TRUE(holds(faultsOf("- 1\n- 2"), {"must be a mapping"}));
  EXPECT_TRUE(holds(faultsOf("chain: 3"), {"chain: must be a list of segments and links"}));
  EXPECT_TRUE(holds(faultsOf(chainOf("  - segment: 3")), {"chain[0].segment: must be a mapping"}));
  EXPECT_TRUE(holds(faultsOf(chainOf("  - 3")), {"chain[0]: must be a mapping"}));
  EXPECT_TRUE(holds(faultsOf("tip: 3\n" + chainOf("  - segment: " + kSegment)), {"tip: must be a mapping"}));
}

// Numbers with three decimals are those that a locale may take for thousands.
TEST(SceneFile, ReadsTheSameNumbersWhateverTheLocaleOfTheProcess) {
  const std::string chain = chainOf("  - segment: " + kSegment + "\n") + "tip: {mass_kg: +1.5e-2, offset_m: [.5, -0.060, 5.]}\n";
  const auto check = [&] {
    const Scene scene = parseScene(chain, "test");
    EXPECT_EQ(scene.length(), 0.04);
    EXPECT_EQ(scene.tip_mass, 0.015);
    EXPECT_EQ(scene.tip_offset, Vector3(0.5, -0.060, 5.0));
    EXPECT_TRUE(holds(faultsOf("tip: {mass_kg: -0.060}\nchain: []"), {"mass_kg = -0.060: must be >= 0"}));
  };
  check();
  const DecimalComma comma;
  check();
  const GermanC german(std::string(::testing::TempDir()) + "scene_file_locale");
  if (!german.isSet()) GTEST_SKIP() << "of C's locales: no localedef, or none of its sources (package locales)";
  check();
}

TEST(SceneFile, SaysHowToWriteANumber) {
  EXPECT_TRUE(holds(faultsOf("tip:\n  mass_kg: 0,015\n  offset_m: [8 mm, 0, 0]\nchain: []"),
                    {"tip.mass_kg = 0,015: must be a number, >= 0; write 0.015 (line 2)",
                     "tip.offset_m[0] = 8 mm: must be a number, any finite number; write the number alone, 8, in the unit"}));
}

TEST(SceneFile, TakesMergeKeys) {
  const std::string text =
      "soft: &soft {youngs_modulus_pa: 120.0e3, poissons_ratio: 0.5}\n"
      "sizes:\n"
      "  - &tube\n"
      "    length_m: 0.060\n"
      "    outer_radius_m: 0.015\n"
      "    chamber_azimuths_deg: []\n"
      "  - &thin {<<: *tube, outer_radius_m: 0.005}\n"
      "weight: &weight 0.012\n"
      "chain:\n"
      "  - segment: {<<: [*tube, *soft], name: lower, length_m: 0.04}\n"
      "  - segment: {name: upper, <<: [*soft, *thin, *tube]}\n"
      "  - segment:\n"
      "      <<: {<<: *tube, youngs_modulus_pa: 1.0e5}\n"
      "      shear_modulus_pa: 4.0e4\n"
      "tip: {mass_kg: *weight}\n";
  ASSERT_EQ(faultsOf(text), "none");
  Scene scene = parseScene(text, "test");
  EXPECT_EQ(segmentOf(scene, 0).name, "lower");
  EXPECT_EQ(segmentOf(scene, 0).length, 0.04);
  EXPECT_EQ(segmentOf(scene, 0).section.outer_radius, 0.015);
  EXPECT_EQ(segmentOf(scene, 1).length, 0.06);
  EXPECT_EQ(segmentOf(scene, 1).section.outer_radius, 0.005);
  EXPECT_EQ(segmentOf(scene, 1).section.youngs_modulus, 120e3);
  EXPECT_EQ(segmentOf(scene, 2).section.youngs_modulus, 1e5);
  EXPECT_EQ(scene.tip_mass, 0.012);
}

TEST(SceneFile, ChecksWhatMergeKeysTakeOver) {
  const std::string merged =
      "defaults: &d\n"
      "  length_m: wide\n"
      "  colour: blue\n"
      "  outer_radius_m: 0.015\n"
      "  outer_radius_m: 0.016\n"
      "chain:\n"
      "  - segment: {<<: *d}\n";
  EXPECT_TRUE(holds(faultsOf(merged), {"chain[0].segment.length_m = wide: must be a number, > 0 (line 2)",
                                       "chain[0].segment.colour: unknown key; known here: ",
                                       "(line 3)", "chain[0].segment.outer_radius_m: is given more than once (line 5)"}));
  EXPECT_EQ(faultsOf(merged).find("defaults:"), std::string::npos);
  EXPECT_TRUE(holds(faultsOf("defaults: {a: }\nchain: []"), {"defaults: unknown key"}));
  EXPECT_TRUE(holds(faultsOf("defaults: &unused {a: 1}\nchain: []"), {"defaults: unknown key"}));
  EXPECT_TRUE(holds(faultsOf("tip: {<<: 3}\nchain: []"), {"tip: << must be a mapping, or a list of mappings"}));
  EXPECT_TRUE(holds(faultsOf("tip: {<<: {}, <<: {}}\nchain: []"), {"tip.<<: is given more than once"}));
  // What refers to itself comes to an end, as does what doubles with every line.
  EXPECT_TRUE(holds(faultsOf("tip: &t {<<: *t, mass_kg: 0.01, colour: 1}\nchain: []"), {"tip.colour: unknown key"}));
  std::string doubling = "a0: &a0 {mass_kg: 0.01}\n";
  for (int i = 1; i <= 64; ++i) {
    const std::string name = "a" + std::to_string(i), from = "*a" + std::to_string(i - 1);
    doubling += name + ": &" + name + " {<<: [" + from + ", " + from + "]}\n";
  }
  EXPECT_EQ(faultsOf(doubling + "tip: {<<: *a64}\n" + chainOf("  - segment: " + kSegment)), "none");
}

TEST(SceneFile, SaysWhichFileCannotBeRead) {
  for (const std::string path : {"/nowhere/robot.yaml", SOURCE_DIR}) {
    try {
      loadSceneFile(path);
      FAIL() << path << " loaded";
    } catch (const ConfigurationError& error) {
      EXPECT_TRUE(holds(error.what(), {path}));
    }
  }
}

}  // namespace
}  // namespace live_stiffness
