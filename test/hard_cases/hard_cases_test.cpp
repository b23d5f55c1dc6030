// Every named hard case as a test: HardCases/HardCase.IsAccurateOrHonest/THEME_NAME.

#include <gtest/gtest.h>

#include <iostream>

#include "hard_cases/hard_case.h"

namespace live_stiffness {
namespace {

struct Named {
  std::string name;
  HardCase hard_case;
};

std::vector<Named> allCases() {
  std::vector<Named> all;
  for (const HardTheme& theme : hardThemes())
    for (const HardCase& c : theme.cases) all.push_back({theme.name + "__" + c.name, c});
  return all;
}

void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

class HardCases : public ::testing::TestWithParam<Named> {};

TEST_P(HardCases, AreAccurateOrHonest) {
  HardOutcome outcome;
  GetParam().hard_case.run(outcome);
  EXPECT_TRUE(outcome.ok()) << outcome.faults() << "\ntruth: " << GetParam().hard_case.truth;
  std::cout << codeName(outcome.worstCode()) << ", error " << outcome.worstError() << ", estimate "
            << outcome.largestEstimate() << ", iterations " << outcome.mostIterations() << "\n";
}

INSTANTIATE_TEST_SUITE_P(All, HardCases, ::testing::ValuesIn(allCases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace live_stiffness
