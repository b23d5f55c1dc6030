#include "estimation/pressure_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "support/scenes.h"

namespace live_stiffness {
namespace {

// After 300 messages of three channels; pressure: of a time in s.
std::string doubtOf(const std::function<double(double)>& pressure, double noise = 25.0) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, noise);
  PressureLevels levels(fullRange(paperScene(1)));
  for (int i = 0; i < 300; ++i)
    levels.add(Vector3(pressure(i / 40.0) + normal(random), pressure(i / 40.0) + normal(random), normal(random) + pressure(0.0)));
  return levels.doubt();
}

TEST(PressureLevels, OfARobotAtRestAndInMotionAreNotDoubted) {
  EXPECT_EQ(doubtOf([](double) { return 0.0; }), "");
  EXPECT_EQ(doubtOf([](double time) { return 3e4 * (1.0 - std::cos(time)); }), "");
}

TEST(PressureLevels, NameTheReferenceAtOneAtmosphere) {
  EXPECT_NE(doubtOf([](double) { return 99e3; }).find("told gauge, sent absolute?"), std::string::npos);
  EXPECT_NE(doubtOf([](double) { return -101325.0; }).find("told absolute, sent gauge?"), std::string::npos);
  EXPECT_EQ(doubtOf([](double time) { return time < 4.0 ? 99e3 : 50e3; }), "") << "it was pressure";
}

TEST(PressureLevels, NameTheUnitOfPressuresAThousandTimesTooSmall) {
  const std::string doubt = doubtOf([](double time) { return 30.0 * (1.0 - std::cos(time)); }, 0.05);
  EXPECT_NE(doubt.find("pressures never exceed 60"), std::string::npos) << doubt;
  EXPECT_NE(doubt.find("pressure_unit"), std::string::npos) << doubt;
}

}  // namespace
}  // namespace live_stiffness
