#include "ros/node_parameters.h"

#include <gtest/gtest.h>
#include <live_stiffness/StiffnessConfig.h>

#include <cmath>

#include "csv_table.h"
#include "parameter_reader.h"

namespace live_stiffness {
namespace {

// Faults of reading and checking parameters of which one is set.
template <class Value>
std::vector<std::string> faultsOf(const std::string& key, const Value& value, NodeParameters& parameters) {
  FaultList faults("parameters", "~");
  YAML::Node values;
  values[key] = value;
  ParameterReader read(values, faults);
  NodeParameters::forEachParameter(parameters, read);
  faults.checkAll(parameters);
  return faults.faults();
}

TEST(NodeParameters, DefaultsAreLegal) {
  FaultList faults("defaults");
  faults.checkAll(NodeParameters());
  EXPECT_TRUE(faults.empty()) << faults.faults().front();
}

TEST(NodeParameters, KeysAreUnique) {
  std::set<std::string> keys;
  NodeParameters parameters;
  NodeParameters::forEachParameter(parameters, [&](const auto& parameter, const auto&) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
  });
}

TEST(NodeParameters, AreReadInTheUnitOfTheKeyAndKeptInSi) {
  NodeParameters parameters;
  EXPECT_TRUE(faultsOf("model_error_rotation_deg", 2, parameters).empty()) << "a whole number is a number";
  EXPECT_NEAR(parameters.contact.model_error_rotation, 2.0 * kDegree, 1e-15);
}

TEST(NodeParameters, EndsOfRangesAreLegalInEveryUnit) {
  NodeParameters parameters;
  NodeParameters::forEachParameter(parameters, [](const auto& parameter, auto& field) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, double>) {
      for (double end : {parameter.range.low, parameter.range.high}) {
        if (!parameter.range.contains(end)) continue;  // open, or infinite
        NodeParameters other;
        EXPECT_TRUE(faultsOf(parameter.key, end, other).empty()) << parameter.key << " = " << end;
        const double beyond = end + (end == parameter.range.low ? -1e-6 : 1e-6) * (std::abs(end) + 1e-3);
        EXPECT_EQ(faultsOf(parameter.key, beyond, other).size(), 1u) << parameter.key << " = " << beyond;
      }
    }
  });
}

TEST(NodeParameters, WrongTypesAreFaultsAndLeaveTheFieldAlone) {
  NodeParameters parameters;
  const std::vector<std::string> text = faultsOf("accuracy", "fine", parameters);
  EXPECT_EQ(text, std::vector<std::string>{"~accuracy = 'fine': must be a number, >= 1e-13 and <= 0.01"});
  EXPECT_EQ(parameters.model.accuracy, kAccuracy.standard);
  EXPECT_EQ(faultsOf("show_eigenscrews", "perhaps", parameters).size(), 1u);
  EXPECT_EQ(faultsOf("wrench_components", 3.5, parameters).size(), 1u) << "not whole";
  EXPECT_EQ(faultsOf("channel_of_chamber", 1.0, parameters).size(), 1u) << "no list";
  EXPECT_EQ(faultsOf("tracker_frame", std::vector<int>{1}, parameters).size(), 1u);
}

// YAML 1.1 takes 1e-8 for a text, and roscpp a list on the command line.
TEST(NodeParameters, TextsThatCanMeanNothingElseAreTaken) {
  NodeParameters parameters;
  EXPECT_TRUE(faultsOf("accuracy", "1e-8", parameters).empty());
  EXPECT_EQ(parameters.model.accuracy, 1e-8);
  EXPECT_TRUE(faultsOf("channel_of_chamber", "[0,0,1,1,2,2]", parameters).empty());
  EXPECT_EQ(parameters.channel_of_chamber, (std::vector<int>{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(faultsOf("channel_of_chamber", "[0, 0", parameters).size(), 1u);
  EXPECT_EQ(faultsOf("channel_of_chamber", "[0, x]", parameters).size(), 1u);
  EXPECT_EQ(faultsOf("accuracy", "1,5", parameters), std::vector<std::string>{
      "~accuracy = '1,5': must be a number, >= 1e-13 and <= 0.01" + numberHint("1,5")});
  EXPECT_NE(numberHint("1,5"), "");
}

TEST(NodeParameters, TheTrackersFrameIsNoSensor) {
  NodeParameters parameters;
  parameters.tracker_tf_frame = parameters.tracker_frame;
  FaultList faults("parameters");
  parameters.check(0, faults);
  EXPECT_EQ(faults.faults().size(), 1u);
}

TEST(NodeParameters, FramesLoseTheirLeadingSlash) {
  NodeParameters parameters;
  EXPECT_TRUE(faultsOf("base_frame", "/robot/base", parameters).empty());
  EXPECT_EQ(parameters.frames.base, "robot/base");
}

TEST(NodeParameters, ReconfiguringTakesOverWhatIsLive) {
  StiffnessConfig config = StiffnessConfig::__getDefault__();
  config.accuracy = 1e-6;
  config.stepping = "continuous";
  config.show_eigenscrews = true;
  NodeParameters before;
  before.heartbeat = 7.0;
  const NodeParameters after = reconfigured(before, config);
  EXPECT_EQ(after.model.accuracy, 1e-6);
  EXPECT_EQ(after.model.stepping, Stepping::kContinuous);
  EXPECT_TRUE(after.show_eigenscrews);
  EXPECT_EQ(after.heartbeat, 7.0) << "not live";
}

// dynamic_reconfigure lets NaN through its limits.
TEST(NodeParameters, ReconfiguringRefusesNaNAndContradictionsAllAtOnce) {
  StiffnessConfig config = StiffnessConfig::__getDefault__();
  config.accuracy = config.ellipsoid_scale_m_per_m_n = std::nan("");
  config.model = "lpcc";
  config.stepping = "continuous";
  try {
    reconfigured(NodeParameters(), config);
    FAIL() << "accepted";
  } catch (const ConfigurationError& error) {
    ASSERT_EQ(error.faults().size(), 3u) << error.what();
    EXPECT_EQ(error.faults()[0], "~accuracy = 'nan': must be a number, >= 1e-13 and <= 0.01");
  }
}

}  // namespace
}  // namespace live_stiffness
