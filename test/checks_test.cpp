#include "live_stiffness/checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/decimal_comma.h"

namespace live_stiffness {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Range, HoldsItsBoundsUnlessTheyAreOpen) {
  const Range closed{0.0, 1.0}, open{0.0, 1.0, true, true};
  EXPECT_TRUE(closed.contains(0.0) && closed.contains(1.0) && closed.contains(0.5));
  EXPECT_FALSE(closed.contains(-1e-300) || closed.contains(1.0000001));
  EXPECT_FALSE(open.contains(0.0) || open.contains(1.0));
  EXPECT_TRUE(open.contains(1e-300));
}

TEST(Range, NeverHoldsNaNOrInfinity) {
  for (const Range& range : {Range::finite(), Range::positive(), Range::nonnegative(), Range{-kInfinity, kInfinity}})
    EXPECT_FALSE(range.contains(std::nan("")) || range.contains(kInfinity) || range.contains(-kInfinity));
}

TEST(Range, SaysWhatItHolds) {
  EXPECT_EQ(Range::finite().text(), "any finite number");
  EXPECT_EQ(Range::positive().text(), "> 0");
  EXPECT_EQ(Range::nonnegative().text(), ">= 0");
  EXPECT_EQ((Range{-1.0, 0.5, true, false}).text(), "> -1 and <= 0.5");
}

TEST(FaultList, ThrowsAllFaultsTogether) {
  FaultList faults("pump");
  faults.check("speed", 2.0, {0.0, 1.0});
  faults.check("flow", 0.5, {0.0, 1.0});
  faults.check("volume", std::nan(""), Range::positive());
  try {
    faults.throwIfAny();
    FAIL() << "did not throw";
  } catch (const ConfigurationError& error) {
    EXPECT_STREQ(error.what(), "pump: 2 faults\n  - speed = 2: must be >= 0 and <= 1\n  - volume = nan: must be > 0");
    EXPECT_EQ(error.faults().size(), 2u);
  }
}

TEST(FaultList, ChecksParametersInTheUnitOfTheirKeys) {
  const NumberParameter angle{"angle_deg", 1.0, {0.0, 57.0}, "", Live::kNo, std::acos(-1.0) / 180.0};
  const ChoiceParameter law{"law", "", {"", "gent", "yeoh"}, ""};
  const NumbersParameter shares{"shares", {}, {0.0, 1.0}, ""};
  FaultList faults("pump", "~");
  faults.check(angle, 57.0 * angle.unit);  // a bound, rounded
  faults.check(law, "");
  faults.check(shares, std::vector<double>{0.0, 1.0});
  EXPECT_TRUE(faults.empty());
  faults.check(angle, 60.0 * angle.unit);
  faults.check(angle, std::nan(""));
  faults.check(law, "hooke");
  faults.check(shares, std::vector<double>{0.5, 2.0});
  EXPECT_EQ(faults.faults(), (std::vector<std::string>{"~angle_deg = 60: must be >= 0 and <= 57",
                                                       "~angle_deg = nan: must be >= 0 and <= 57",
                                                       "~law = hooke: must be one of gent, yeoh",
                                                       "~shares[1] = 2: must be >= 0 and <= 1"}));
}

TEST(NumberText, HasAPointWhateverTheLocaleOfTheProcess) {
  const DecimalComma comma;
  EXPECT_EQ(numberText(1234.5), "1234.5");
  EXPECT_EQ(fixedText(1234.567, 2), "1234.57");
  EXPECT_EQ(std::string(ConfigurationError("pump", std::vector<std::string>(1000, "f")).what()).substr(0, 17),
            "pump: 1000 faults");
}

TEST(FaultList, WithoutFaultsDoesNotThrow) {
  FaultList faults("pump");
  faults.check("flow", 0.5, {0.0, 1.0});
  EXPECT_TRUE(faults.empty());
  EXPECT_NO_THROW(faults.throwIfAny());
}

}  // namespace
}  // namespace live_stiffness
