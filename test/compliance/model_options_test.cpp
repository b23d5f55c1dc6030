#include "live_stiffness/compliance/model_options.h"

#include <gtest/gtest.h>

namespace live_stiffness {
namespace {

ModelOptions named(const std::string& model, const std::string& stepping) {
  FaultList faults("options");
  const ModelOptions options = namedModelOptions(model, stepping, faults);
  faults.throwIfAny();
  return options;
}

TEST(ModelOptions, ThePapersNamesAreTwoSwitches) {
  EXPECT_FALSE(named("lpcc", "").external_loads);
  EXPECT_FALSE(named("npcc", "").external_loads);
  EXPECT_TRUE(named("lcm", "").external_loads);
  EXPECT_TRUE(named("ncm", "").external_loads);
  EXPECT_EQ(named("lpcc", "").stepping, Stepping::kLinear);
  EXPECT_EQ(named("lcm", "").stepping, Stepping::kLinear);
  EXPECT_EQ(named("npcc", "").stepping, Stepping::kFixedStep);
  EXPECT_EQ(named("ncm", "continuous").stepping, Stepping::kContinuous);
  EXPECT_EQ(named("", "linear").stepping, Stepping::kLinear);
  EXPECT_EQ(named("", "").stepping, Stepping::kFixedStep);
  for (const char* model : {"lpcc", "npcc", "lcm", "ncm"}) {
    std::string upper = modelName(named(model, ""));
    for (char& letter : upper) letter = static_cast<char>(std::tolower(letter));
    EXPECT_EQ(upper, model);
  }
}

TEST(ModelOptions, ContradictionsAndUnknownNamesAreFaults) {
  EXPECT_THROW(named("lcm", "continuous"), ConfigurationError);
  EXPECT_THROW(named("npcc", "linear"), ConfigurationError);
  EXPECT_THROW(named("NCM", ""), ConfigurationError);
  EXPECT_THROW(named("", "euler"), ConfigurationError);
  FaultList faults("options");
  namedModelOptions("best", "fastest", faults);
  EXPECT_EQ(faults.faults().size(), 2u) << "all faults at once";
}

}  // namespace
}  // namespace live_stiffness
