#include "rig/pressure_program.h"

#include <gtest/gtest.h>

#include <cmath>

namespace live_stiffness {
namespace {

const char* const kKinds[] = {"triangle", "staircase", "random_walk"};

PressureProgram makeProgram(int channels, const char* kind, std::uint64_t seed = 1) {
  return {channels, {kind, 80000.0, 10.0}, seed};
}

TEST(PressureProgram, StartsAtZeroOnEveryChannel) {
  for (const char* kind : kKinds) {
    const PressureProgram program = makeProgram(3, kind);
    EXPECT_EQ(program.at(0.0), Pressures::Zero(3)) << kind;
    EXPECT_EQ(program.at(-5.0), Pressures::Zero(3)) << kind;
  }
}

TEST(PressureProgram, StaysWithinTheAmplitudeAndUsesMostOfIt) {
  for (const char* kind : kKinds) {
    const PressureProgram program = makeProgram(3, kind);
    Pressures highest = Pressures::Zero(3);
    for (double t = 0.0; t < 1000.0; t += 0.1) {
      const Pressures p = program.at(t);
      ASSERT_GE(p.minCoeff(), 0.0) << kind << " at " << t;
      ASSERT_LE(p.maxCoeff(), 80000.0) << kind << " at " << t;
      highest = highest.cwiseMax(p);
    }
    EXPECT_GT(highest.minCoeff(), 0.9 * 80000.0) << kind;
  }
}

TEST(PressureProgram, NeverJumps) {
  // Steepest: a third (staircase; 1 in its fall) of the amplitude blended over 2 s, 15/8 of the mean slope.
  const double steepest = 80000.0 / 2.0 * 15.0 / 8.0;
  const double dt = 1e-3;
  for (const char* kind : kKinds) {
    const PressureProgram program = makeProgram(3, kind);
    for (double t = 0.0; t < 130.0; t += dt)  // all three channels of the staircase, and over its end
      ASSERT_LE((program.at(t + dt) - program.at(t)).cwiseAbs().maxCoeff(), 1.001 * steepest * dt)
          << kind << " at " << t;
  }
}

TEST(PressureProgram, TriangleChannelsFollowOneAnother) {
  const PressureProgram program = makeProgram(2, "triangle");
  EXPECT_NEAR(program.at(5.0)[0], 80000.0, 1e-6);   // half a period
  EXPECT_NEAR(program.at(5.0)[1], 0.0, 1e-6);       // about to start
  EXPECT_NEAR(program.at(7.5)[1], 40000.0, 1e-6);
  EXPECT_NEAR(program.at(20.0)[0], 0.0, 1e-6);      // periodic
}

TEST(PressureProgram, StaircaseTakesOneChannelAtATimeInThirds) {
  const PressureProgram program = makeProgram(2, "staircase");
  EXPECT_NEAR(program.at(9.0)[0], 80000.0 / 3.0, 1e-6);
  EXPECT_NEAR(program.at(19.0)[0], 160000.0 / 3.0, 1e-6);
  EXPECT_NEAR(program.at(29.0)[0], 80000.0, 1e-6);
  EXPECT_NEAR(program.at(39.0)[0], 0.0, 1e-6);
  EXPECT_NEAR(program.at(69.0)[1], 80000.0, 1e-6);
  for (double t = 0.0; t < 200.0; t += 0.5) EXPECT_EQ(program.at(t).minCoeff(), 0.0) << t;
}

TEST(PressureProgram, RandomWalkDependsOnTheSeedAlone) {
  const PressureProgram a = makeProgram(3, "random_walk", 5), b = makeProgram(3, "random_walk", 5);
  const PressureProgram other = makeProgram(3, "random_walk", 6);
  const Pressures late = a.at(500.0);  // asked for first: the order of questions does not matter
  EXPECT_EQ(a.at(15.0), b.at(15.0));
  EXPECT_EQ(b.at(500.0), late);
  EXPECT_GT((a.at(15.0) - other.at(15.0)).norm(), 1.0);
  EXPECT_GT(std::abs(a.at(15.0)[0] - a.at(15.0)[1]), 1.0);  // channels walk on their own
}

TEST(PressureProgram, RandomWalkHasNoEndAndNoJumpAtItsTurn) {
  const PressureProgram program = makeProgram(1, "random_walk");
  const double turn = 10230.0;  // 1023 steps of 10 s
  EXPECT_NEAR(program.at(turn - 3.0)[0], program.at(turn + 3.0)[0], 1e-6);
  EXPECT_NEAR(program.at(2.0 * turn + 12.0)[0], program.at(12.0)[0], 1e-6);
}

TEST(PressureProgram, RefusesBadOptionsAllAtOnce) {
  try {
    PressureProgram(0, {"square", -1.0, std::nan("")}, 1);
    FAIL() << "accepted";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.faults().size(), 4u) << error.what();
  }
}

}  // namespace
}  // namespace live_stiffness
