// What a calibration reads and writes.

#include <gtest/gtest.h>

#include <cstdio>

#include "calibration/compliance_table.h"
#include "calibration/scene_text.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/rod/scene_file.h"
#include "support/decimal_comma.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

TEST(SceneText, ReadsBackToTheSameScene) {
  for (StretchLaw law : {StretchLaw::kSectionUpdate, StretchLaw::kNeoHookean, StretchLaw::kGent, StretchLaw::kYeoh}) {
    Scene scene = paperScene(2);
    Material& material = segmentOf(scene, 0).section.material;
    material.law = law;
    if (law == StretchLaw::kGent) material.gent_limit = 1.0 / 3.0;
    if (law == StretchLaw::kYeoh) material.yeoh_c2 = 0.1, material.yeoh_c3 = -0.01;
    material.pressure_stiffening = 1.7;
    material.creep_share = 0.05;
    material.creep_time = 2.3;
    segmentOf(scene, 0).section.chambers.area_growth = 1.1e-6;
    const std::string text = sceneText(scene, "two\nlines");
    EXPECT_EQ(text.rfind("# two\n# lines\n", 0), 0u);
    const Scene back = parseScene(text, "back");
    EXPECT_EQ(sceneText(back, "two\nlines"), text);
    const CrossSection& section = std::get<Segment>(back.chain[0]).section;
    EXPECT_EQ(section.material.law, law);
    EXPECT_EQ(section.material.gent_limit, material.gent_limit);
    EXPECT_EQ(section.material.yeoh_c3, material.yeoh_c3);
    EXPECT_EQ(section.material.pressure_stiffening, 1.7);
    EXPECT_EQ(section.material.creep_time, 2.3);
    EXPECT_EQ(section.chambers.area_growth, 1.1e-6);
    EXPECT_EQ(section.shear_modulus, segmentOf(scene, 0).section.shear_modulus);
    EXPECT_EQ(back.tip_mass, scene.tip_mass);
    EXPECT_EQ(back.gravity->z(), scene.gravity->z());
  }
}

TEST(SceneText, KeepsAnyName) {
  for (const char* name : {"segment #1", "a: b", "- a", "[a", "{a", "\"a\"", "it's", " a ", "null", "~", "&a", "*a", "!a",
                           "%a", "@a", "\\", "two\nlines", "tab\t\r", "\xC3\xBC", "1,5", "a\x01\x7f"}) {
    Scene scene = paperScene(1);
    segmentOf(scene, 0).name = name;
    Scene back = parseScene(sceneText(scene, "comment"), "back");
    EXPECT_EQ(segmentOf(back, 0).name, name);
  }
}

// What could not be read again leaves what was there before.
TEST(SceneText, IsWrittenWholeAndLoadableOrNotAtAll) {
  const std::string path = std::string(::testing::TempDir()) + "scene_text.yaml";
  Scene scene = paperScene(1);
  {
    const DecimalComma comma;
    saveSceneFile(path, scene, "before");
  }
  segmentOf(scene, 0).section.youngs_modulus = -1.0;
  try {
    saveSceneFile(path, scene);
    FAIL() << "written";
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("not written, since it could not be read again"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("youngs_modulus_pa = -1: must be > 0"), std::string::npos) << error.what();
  }
  EXPECT_EQ(readTextFile("scene", path), sceneText(paperScene(1), "before"));
  std::remove(path.c_str());
}

TEST(SceneFile, RefusesMaterialsThatDoNotFitTogether) {
  const auto with = [](const std::string& keys) {
    std::string text = sceneText(paperScene(1));
    text.replace(text.find("      youngs"), 0, keys);
    return text;
  };
  EXPECT_NO_THROW(parseScene(with("      stretch_law: yeoh\n      yeoh_c2: 0.1\n"), "yeoh"));
  for (const char* bad : {"      stretch_law: rubber\n", "      stretch_law: gent\n", "      gent_limit: 5.0\n",
                          "      stretch_law: neo_hookean\n      yeoh_c2: 0.1\n", "      pressure_stiffening: -1.0\n",
                          "      creep_share: 1.0\n", "      creep_time_s: 0.0\n",
                          "      chamber_area_growth_per_pa: 1.0e-5\n"})
    EXPECT_THROW(parseScene(with(bad), "bad"), ConfigurationError) << bad;
}

TEST(ComplianceTable, FindsColumnsByName) {
  const auto rows = parseComplianceTable(
      "c11_m_per_n,c21_m_per_n,c31_m_per_n,c12_m_per_n,c22_m_per_n,c32_m_per_n,c13_m_per_n,c23_m_per_n,c33_m_per_n,"
      "pressure_2_pa,pressure_1_pa\n1,2,3,4,5,6,7,8,9,20,10\n", "t", 2);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].pressures[0], 10.0);
  EXPECT_EQ(rows[0].pressures[1], 20.0);
  EXPECT_EQ(rows[0].compliance(1, 0), 2.0);  // c21: displacement along 2 per force along 1
  EXPECT_EQ(rows[0].compliance(0, 1), 4.0);
}

TEST(ComplianceTable, IsReadFromASpreadsheet) {
  const auto rows = parseComplianceTable(
      "\xEF\xBB\xBFpressure_1_pa;c11_m_per_n;c21_m_per_n;c31_m_per_n;c12_m_per_n;c22_m_per_n;c32_m_per_n;c13_m_per_n;c23_m_per_n;"
      "c33_m_per_n\r\nPa;m/N;;;;;;;;\r\n4e4;0,5;0;0;0;0,25;0;0;0;0,125\r\n", "t", 1);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].name, "t line 3");
  EXPECT_EQ(rows[0].compliance.diagonal(), Vector3(0.5, 0.25, 0.125));
}

TEST(ComplianceTable, ListsEveryFault) {
  try {
    parseComplianceTable("pressure_1_pa,c11_m_per_n\n1,2\n", "t", 2);
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.faults().size(), 9u);  // pressure_2 and eight entries
  }
  EXPECT_THROW(parseComplianceTable("", "t", 1), ConfigurationError);
}

}  // namespace
}  // namespace live_stiffness
