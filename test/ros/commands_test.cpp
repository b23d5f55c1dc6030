// ~pause, ~reset, ~reload and dynamic_reconfigure of a stiffness_node, which here is a nodelet. See commands.test.

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

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

// With a new scene: the channels that do not fit are the only fault, and are found last. Alone: it must not spoil a later ~reset.
TEST_F(CommandsTest, ReloadWithChannelsThatDoNotFitChangesNothing) {
  const std::string path = parameter("scene_file"), good = contentOf(path);
  const double before = expectedHeight(path);
  for (const bool is_new_scene : {true, false}) {
    if (is_new_scene) std::ofstream(path) << contentOf(parameter("other_scene_file"));
    node_.setParam("/stiffness_node/channel_of_chamber",
                   is_new_scene ? std::vector<int>{0, 0, 1, 1, 2, 2} : std::vector<int>{0, 0, 1, 1, 2});
    const std_srvs::Trigger::Response refused = trigger("reload");
    EXPECT_FALSE(refused.success);
    EXPECT_NE(refused.message.find("channel_of_chamber"), std::string::npos) << refused.message;
    EXPECT_TRUE(publishUntil([&] { return tipIsAt(before); })) << watched_.estimate->message;
    EXPECT_TRUE(trigger("reset").success);
    EXPECT_TRUE(publishUntil([&] { return tipIsAt(before); })) << watched_.estimate->message;
    std::ofstream(path) << good;
    node_.setParam("/stiffness_node/channel_of_chamber", std::vector<int>());
    EXPECT_TRUE(trigger("reload").success);
  }
}

// What a viewer shows, by namespace.
class Viewer {
 public:
  int count(const std::string& name) const {
    return static_cast<int>(std::count_if(shown_.begin(), shown_.end(), [&](const Id& id) { return id.first == name; }));
  }
  long pictures = 0;
  bool always_finite = true, began_empty = false;

 private:
  using Marker = visualization_msgs::Marker;
  using Id = std::pair<std::string, int>;

  void onMarkers(const visualization_msgs::MarkerArray::ConstPtr& message) {
    ++pictures;
    for (const Marker& marker : message->markers) {
      if (marker.action == Marker::DELETEALL) {
        shown_.clear();
        began_empty = true;
      } else if (marker.action == Marker::DELETE) {
        shown_.erase({marker.ns, marker.id});
      } else {
        shown_.emplace(marker.ns, marker.id);
      }
      for (double size : {marker.scale.x, marker.scale.y, marker.scale.z}) always_finite = always_finite && std::isfinite(size);
      for (const auto& point : marker.points) always_finite = always_finite && std::isfinite(point.x);
    }
  }

  std::set<Id> shown_;
  ros::NodeHandle node_;
  ros::Subscriber markers_ = node_.subscribe("/stiffness_node/markers", 10, &Viewer::onMarkers, this);
};

TEST_F(CommandsTest, WhatIsNotDrawnAnyMoreIsDeleted) {
  Viewer viewer;
  const auto switchEigenscrews = [&](bool on) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.bools.resize(1);
    call.request.config.bools[0].name = "show_eigenscrews";
    call.request.config.bools[0].value = on;
    EXPECT_TRUE(ros::service::call("/stiffness_node/set_parameters", call));
  };
  switchEigenscrews(true);
  EXPECT_TRUE(publishUntil([&] { return viewer.count("eigenscrews") == 12; }));
  EXPECT_TRUE(viewer.began_empty) << "of what an earlier run has drawn";
  switchEigenscrews(false);
  EXPECT_TRUE(publishUntil([&] { return viewer.count("eigenscrews") == 0; }));

  const std::string path = parameter("scene_file"), good = contentOf(path);
  const int ellipsoids = viewer.count("ellipsoids");
  ASSERT_GT(ellipsoids, 0);
  std::ofstream(path) << contentOf(parameter("other_scene_file"));
  ASSERT_TRUE(trigger("reload").success);
  EXPECT_TRUE(waitFor([&] { return viewer.count("ellipsoids") == 0; })) << "no estimate of the new robot yet";
  ros::Publisher pressures = node_.advertise<ChamberPressures>("chamber_pressures", 10);
  EXPECT_TRUE(live_stiffness::publishUntil(
      [&] { pressures.publish(toPressures(Pressures::Constant(12, 10e3), ros::Time::now())); },
      [&] { return viewer.count("ellipsoids") == 2 * ellipsoids; }));
  std::ofstream(path) << good;
  ASSERT_TRUE(trigger("reload").success);
  EXPECT_TRUE(publishUntil([&] { return viewer.count("ellipsoids") == ellipsoids && watched_.solvedFor(bent_); }));
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
  Viewer viewer;
  const auto description = ros::topic::waitForMessage<dynamic_reconfigure::ConfigDescription>(
      "/stiffness_node/parameter_descriptions", ros::Duration(20.0));
  ASSERT_NE(description, nullptr);
  for (const auto& entry : description->dflt.doubles) {
    SCOPED_TRACE(entry.name);
    EXPECT_EQ(valueOf(reconfigure(entry.name, std::nan("")), entry.name), entry.value);
    double stored = 0.0;
    EXPECT_TRUE(node_.getParam("/stiffness_node/" + entry.name, stored));
    EXPECT_EQ(stored, entry.value);
  }
  const long before = viewer.pictures;
  EXPECT_TRUE(publishUntil([&] { return viewer.pictures > before + 2; }));
  EXPECT_TRUE(viewer.always_finite);
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
