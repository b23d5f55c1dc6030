#include "ros/contact_parameters.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

namespace live_stiffness {
namespace {

TEST(ContactParameters, TheFileGivesTheDefaults) {
  const YAML::Node file = YAML::LoadFile(SOURCE_DIR "/config/stiffness_node.yaml");
  TipWrenchOptions defaults;
  for (const ContactParameter& parameter : contactParameters(defaults)) {
    ASSERT_TRUE(file[parameter.key].IsDefined()) << parameter.key;
    const double expected = *parameter.value / parameter.factor;
    // The file has seven digits at most.
    EXPECT_NEAR(file[parameter.key].as<double>(), expected, 1e-6 * expected) << parameter.key;
  }
  EXPECT_EQ(file["wrench_components"].as<int>(), defaults.components);
  EXPECT_EQ(file["reaccept_samples"].as<int>(), defaults.reaccept);
}

TEST(ContactParameters, DefaultsAreWithinTheirRanges) {
  TipWrenchOptions defaults;
  for (const ContactParameter& parameter : contactParameters(defaults))
    EXPECT_TRUE(parameter.range.contains(*parameter.value / parameter.factor)) << parameter.key;
}

// What the reader accepts the estimator accepts: both ends of every range, one at a time.
TEST(ContactParameters, EndsOfTheRangesAreLegalForTheEstimator) {
  TipWrenchOptions names;
  const size_t count = contactParameters(names).size();
  for (size_t k = 0; k < count; ++k) {
    for (bool high : {false, true}) {
      TipWrenchOptions options;
      const ContactParameter parameter = contactParameters(options)[k];
      if (parameter.low != nullptr || parameter.high != nullptr) continue;
      *parameter.value = parameter.factor * (high ? parameter.range.high : parameter.range.low);
      if (parameter.value == &options.robust_from) options.gate = 1000.0;
      if (parameter.value == &options.contact.on_force) options.contact.off_force = 0.0;
      if (parameter.value == &options.contact.on_sigmas) options.contact.off_sigmas = 0.0;
      FaultList faults("options");
      options.check(faults);
      EXPECT_TRUE(faults.empty()) << parameter.key << ": " << (faults.empty() ? "" : faults.faults().front());
    }
  }
}

}  // namespace
}  // namespace live_stiffness
