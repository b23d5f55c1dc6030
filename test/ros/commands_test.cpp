// ~pause, ~reset, ~reload and dynamic_reconfigure of a stiffness_node, which here is a nodelet. See commands.test.

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <fstream>
#include <iterator>

#include "live_stiffness/rod/scene_file.h"
#include "ros/node_parameters.h"
#include "support/driven_node.h"

namespace live_stiffness {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class CommandsTest : public ::testing::Test {
 protected:
  CommandsTest() : watched_("/stiffness_node"), pressures_(node_.advertise<ChamberPressures>("chamber_pressures", 10)) {}

  void SetUp() override {
    ASSERT_TRUE(ros::service::waitForService("/stiffness_node/reload", ros::Duration(20.0)));
    ASSERT_TRUE(publishUntil([&] { return watched_.solvedFor(bent_); }));
  }

  template <class Condition>
  bool publishUntil(Condition condition) {
    return live_stiffness::publishUntil([&] { pressures_.publish(toPressures(bent_, ros::Time::now())); }, condition);
  }

  std_srvs::Trigger::Response trigger(const std::string& name) {
    std_srvs::Trigger call;
    EXPECT_TRUE(ros::service::call("/stiffness_node/" + name, call));
    return call.response;
  }

  bool pause(bool is_paused) {
    std_srvs::SetBool call;
    call.request.data = is_paused;
    return ros::service::call("/stiffness_node/pause", call) && call.response.success;
  }

  // The configuration that then holds.
  dynamic_reconfigure::Config reconfigure(const std::string& key, double value) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.doubles.resize(1);
    call.request.config.doubles[0].name = key;
    call.request.config.doubles[0].value = value;
    EXPECT_TRUE(ros::service::call("/stiffness_node/set_parameters", call));
    return call.response.config;
  }
  static double valueOf(const dynamic_reconfigure::Config& config, const std::string& key) {
    for (const auto& entry : config.doubles)
      if (entry.name == key) return entry.value;
    ADD_FAILURE() << key << " is not in the configuration";
    return 0.0;
  }

  double expectedHeight(const std::string& scene) const {
    const StiffnessModel model(loadSceneFile(scene), ModelOptions());
    StiffnessWorkspace workspace = model.makeWorkspace();
    return model.solve(bent_, Wrench::Zero(), workspace).X_BT.p.z();
  }
  bool tipIsAt(double height) const {  // both within the model's accuracy, of 50 mm
    return watched_.solvedFor(bent_) && std::abs(watched_.estimate->tip_pose.position.z - height) < 1e-8;
  }

  const Pressures bent_ = pressuresOf({60e3, 60e3, 0.0, 0.0, 0.0, 0.0});
  ros::NodeHandle node_;
  Watched watched_;
  ros::Publisher pressures_;
};

// They are subscribers of one process, which roscpp connects once.
TEST_F(CommandsTest, NodeletsOfOneManagerHearTheSameMessages) {
  Watched twin("/twin");
  ASSERT_TRUE(publishUntil([&] { return twin.solvedFor(bent_); }));
  EXPECT_TRUE(twin.always_finite);
  EXPECT_NEAR(twin.estimate->tip_pose.position.z, watched_.estimate->tip_pose.position.z, 1e-8);
}

TEST_F(CommandsTest, PausedEstimatesAreStaleUntilTheNodeGoesOn) {
  ASSERT_TRUE(pause(true));
  EXPECT_TRUE(publishUntil([&] { return watched_.estimate->stale; }));
  EXPECT_NE(watched_.estimate->message.find("paused"), std::string::npos) << watched_.estimate->message;
  EXPECT_EQ(watched_.estimate->status, StiffnessEstimate::OK);
  ASSERT_TRUE(pause(false));
  EXPECT_TRUE(publishUntil([&] { return watched_.solvedFor(bent_); }));
}

TEST_F(CommandsTest, ResetForgetsTheKnownWrench) {
  const double free = expectedHeight(parameter("scene_file"));
  ros::Publisher wrenches = node_.advertise<geometry_msgs::WrenchStamped>("tip_wrench", 10);
  Wrench wrench = Wrench::Zero();
  wrench[0] = 0.05;
  const auto isPushed = [&] {
    wrenches.publish(toWrenchStamped(wrench, ros::Time::now(), "base"));
    return watched_.estimate->tip_wrench.force.x == 0.05;
  };
  ASSERT_TRUE(publishUntil(isPushed));
  EXPECT_TRUE(trigger("reset").success);
  // tip_wrench_timeout_s is 0: by itself it would stay. One that was still on its way is known again.
  EXPECT_TRUE(publishUntil([&] {
    if (watched_.estimate->tip_wrench.force.x != 0.0) {
      EXPECT_TRUE(trigger("reset").success);
    }
    return tipIsAt(free);
  }));
}

TEST_F(CommandsTest, ReloadTakesANewSceneAndKeepsTheOldWhenTheNewIsBad) {
  const std::string path = parameter("scene_file"), good = contentOf(path);
  const double before = expectedHeight(path);
  ASSERT_TRUE(publishUntil([&] { return tipIsAt(before); }));

  std::ofstream(path) << "chain: [{segment: {length_m: -1.0, youngs_modulus_pa: soft}}]\n";
  const std_srvs::Trigger::Response refused = trigger("reload");
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("length_m"), std::string::npos) << refused.message;
  EXPECT_NE(refused.message.find("youngs_modulus_pa"), std::string::npos) << "all faults are listed: " << refused.message;
  EXPECT_TRUE(publishUntil([&] { return tipIsAt(before); }));

  std::string stiffer = good;
  const std::string modulus = "youngs_modulus_pa: 90060.0";
  ASSERT_NE(stiffer.find(modulus), std::string::npos);
  stiffer.replace(stiffer.find(modulus), modulus.size(), "youngs_modulus_pa: 120000.0");
  std::ofstream(path) << stiffer;
  const double after = expectedHeight(path);
  ASSERT_GT(std::abs(after - before), 1e-4);
  EXPECT_TRUE(trigger("reload").success);
  EXPECT_TRUE(publishUntil([&] { return tipIsAt(after); }));

  std::ofstream(path) << good;
  EXPECT_TRUE(trigger("reload").success);
  EXPECT_TRUE(publishUntil([&] { return tipIsAt(before); }));
}

TEST_F(CommandsTest, ReconfiguringChangesTheRunningModelAndItsParameters) {
  reconfigure("accuracy", 1e-3);
  EXPECT_TRUE(publishUntil([&] { return watched_.solvedFor(bent_) && watched_.estimate->numerical_error > 1e-9; }));
  double dumped = 0.0;
  EXPECT_TRUE(node_.getParam("/stiffness_node/accuracy", dumped));
  EXPECT_EQ(dumped, 1e-3);
  reconfigure("accuracy", 1e-9);
  EXPECT_TRUE(publishUntil([&] { return watched_.solvedFor(bent_) && watched_.estimate->numerical_error <= 1e-9; }));
}

// Whether parameters that are as in the file but for this one are accepted at start.
bool isAcceptedAtStart(const std::string& key, double value) {
  const ros::NodeHandle tried("/tried");
  double otherwise = 0.0;
  EXPECT_TRUE(tried.getParam(key, otherwise)) << key << " is not in the parameter file";
  tried.setParam(key, value);
  bool accepted = true;
  try {
    loadNodeParameters(tried);
  } catch (const ConfigurationError&) {
    accepted = false;
  }
  tried.setParam(key, otherwise);
  return accepted;
}

TEST_F(CommandsTest, ReconfiguringHasTheDefaultsAndRangesOfTheStart) {
  const auto description = ros::topic::waitForMessage<dynamic_reconfigure::ConfigDescription>(
      "/stiffness_node/parameter_descriptions", ros::Duration(20.0));
  ASSERT_NE(description, nullptr);
  ASSERT_FALSE(description->dflt.doubles.empty());
  for (const auto& entry : description->dflt.doubles) {
    SCOPED_TRACE(entry.name);
    double in_file = 0.0;
    EXPECT_TRUE(ros::param::get("/defaults/" + entry.name, in_file));
    EXPECT_EQ(entry.value, in_file);
    const double low = valueOf(description->min, entry.name), high = valueOf(description->max, entry.name);
    EXPECT_TRUE(isAcceptedAtStart(entry.name, low));
    EXPECT_TRUE(isAcceptedAtStart(entry.name, high));
    constexpr double kBeyond = 1e-6;
    EXPECT_FALSE(isAcceptedAtStart(entry.name, low - kBeyond * (std::abs(low) + 1e-3)));
    EXPECT_FALSE(isAcceptedAtStart(entry.name, high * (1.0 + kBeyond)));
  }
}

TEST_F(CommandsTest, ReconfiguringRefusesWhatDoesNotFitTogether) {
  dynamic_reconfigure::Reconfigure call;
  call.request.config.strs.resize(1);
  call.request.config.strs[0].name = "stepping";
  call.request.config.strs[0].value = "linear";  // contradicts ncm
  ASSERT_TRUE(ros::service::call("/stiffness_node/set_parameters", call));
  for (const auto& entry : call.response.config.strs) {
    if (entry.name == "stepping") {
      EXPECT_EQ(entry.value, "");
    }
  }
}

// dynamic_reconfigure itself lets NaN through its limits.
TEST_F(CommandsTest, ReconfiguringRefusesNaNAndKeepsTheValue) {
  EXPECT_EQ(valueOf(reconfigure("accuracy", std::nan("")), "accuracy"), 1e-9);
  EXPECT_EQ(valueOf(reconfigure("ellipsoid_scale_m_per_m_n", std::nan("")), "ellipsoid_scale_m_per_m_n"), 0.3);
  double stored = 0.0;
  EXPECT_TRUE(node_.getParam("/stiffness_node/accuracy", stored));
  EXPECT_EQ(stored, 1e-9);
  EXPECT_TRUE(publishUntil([&] { return tipIsAt(expectedHeight(parameter("scene_file"))); }));
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "commands_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
