#include "estimation/creep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {
namespace {

Scene creepingScene() {
  Scene scene = loadSceneFile(SOURCE_DIR "/config/scenes/paper_one_segment.yaml");
  Material& material = std::get<Segment>(scene.chain.front()).section.material;
  material.creep_share = 0.2;
  material.creep_time = 3.0;
  return scene;
}

TEST(SceneCreep, LetsThePressuresOfASceneWithoutCreepThrough) {
  SceneCreep creep(loadSceneFile(SOURCE_DIR "/config/scenes/paper_one_segment.yaml"));
  EXPECT_FALSE(creep.exists());
  creep.update(Pressures::Zero(6), 0.0);
  EXPECT_EQ(creep.update(Pressures::Constant(6, 5e4), 0.1), Pressures::Constant(6, 5e4));
}

TEST(SceneCreep, AStepArrivesLessItsShareAndTheRestWithItsTimeConstant) {
  SceneCreep creep(creepingScene());
  EXPECT_TRUE(creep.exists());
  creep.update(Pressures::Zero(6), 10.0);
  const Pressures step = Pressures::Constant(6, 5e4);
  EXPECT_NEAR(creep.update(step, 10.0)[0], 0.8 * 5e4, 1e-9);
  Pressures effective;
  for (int k = 1; k <= 60; ++k) effective = creep.update(step, 10.0 + 0.1 * k);
  EXPECT_NEAR(effective[0], 5e4 * (1.0 - 0.2 * std::exp(-2.0)), 1e-6);  // after two time constants
}

TEST(SceneCreep, ApproachesTheStepExponentiallyInStepsOfAnySize) {
  SceneCreep creep(creepingScene());
  Pressures pressures(2);
  pressures << 0.0, 100.0;
  EXPECT_EQ(creep.update(pressures, 0.0)[1], 100.0);  // long there: settled
  pressures << 1000.0, 100.0;
  EXPECT_DOUBLE_EQ(creep.update(pressures, 0.0)[0], 800.0);
  double last = 0.0;
  for (int k = 1; k <= 6; ++k) last = creep.update(pressures, 0.5 * k)[0];
  EXPECT_NEAR(last, 1000.0 * (1.0 - 0.2 * std::exp(-1.0)), 1e-9);  // 3 s
  EXPECT_DOUBLE_EQ(creep.update(pressures, 1e9)[0], 1000.0);
}

TEST(SceneCreep, SettlesAnewWhenTheClockIsSetBackAndNotWhenAMessageIsLate) {
  SceneCreep creep(creepingScene());
  const Pressures step = Pressures::Constant(6, 5e4);
  creep.update(Pressures::Zero(6), 10.0);
  const double late = creep.update(step, 9.5)[0];
  EXPECT_NEAR(late, 0.8 * 5e4, 1e-9);
  EXPECT_NEAR(creep.update(step, 5.0)[0], 5e4, 1e-9);
}

}  // namespace
}  // namespace live_stiffness
