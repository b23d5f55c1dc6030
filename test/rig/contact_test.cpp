#include "rig/contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace live_stiffness {
namespace {

Contact pushes() {
  Contact options;
  options.wrench << 0.8, 0.0, -0.1, 0.002, 0.0, 0.001;
  options.start = 2.0;
  options.duration = 3.0;
  options.ramp = 1.0;
  options.period = 8.0;
  options.turn = radians(90.0);
  return options;
}

TEST(Contact, NothingTouchesUnlessAsked) {
  const Contact contact;
  EXPECT_FALSE(contact.exists());
  for (double t = 0.0; t < 50.0; t += 0.5) EXPECT_EQ(contact.at(t), Wrench::Zero());
}

TEST(Contact, TouchesDuringItsPushesAndAtNoOtherTime) {
  const Contact contact = pushes();
  EXPECT_TRUE(contact.exists());
  for (double t = -1.0; t < 40.0; t += 0.125) {
    const double into = std::fmod(t - 2.0 + 80.0, 8.0);  // 80: ten periods, for a positive argument
    const bool pushed = t > 2.0 && into > 0.0 && into < 3.0;
    EXPECT_EQ(contact.at(t).norm() > 0.0, pushed) << t;
  }
}

TEST(Contact, HoldsItsHeightBetweenTheRampsAndIsHalfOfItInTheirMiddle) {
  const Contact contact = pushes();
  for (double t : {3.0, 3.5, 4.0}) EXPECT_EQ(contact.at(t), pushes().wrench) << t;
  EXPECT_LT((contact.at(2.5) - 0.5 * pushes().wrench).norm(), 1e-15);
  EXPECT_LT((contact.at(4.5) - 0.5 * pushes().wrench).norm(), 1e-15);
}

TEST(Contact, RampsNeverJump) {
  const Contact contact = pushes();
  // A quintic blend is at most 15/8 as steep as its mean.
  const double steepest = 15.0 / 8.0 * pushes().wrench.norm() / 1.0;
  for (double t = 1.0; t < 12.0; t += 1e-3)
    ASSERT_LE((contact.at(t + 1e-3) - contact.at(t)).norm(), 1.001 * steepest * 1e-3) << t;
}

TEST(Contact, TurnsAboutTheBaseAxisFromPushToPush) {
  const Contact contact = pushes();
  Wrench turned;
  turned << 0.0, 0.8, -0.1, 0.0, 0.002, 0.001;  // a quarter turn
  EXPECT_LT((contact.at(11.5) - turned).norm(), 1e-15);
  turned << -0.8, 0.0, -0.1, -0.002, 0.0, 0.001;
  EXPECT_LT((contact.at(19.5) - turned).norm(), 1e-15);
}

TEST(Contact, PushesOnceWithoutAPeriod) {
  Contact once = pushes();
  once.period = 0.0;
  EXPECT_EQ(once.at(3.5), once.wrench);
  for (double t = 5.0; t < 100.0; t += 0.5) EXPECT_EQ(once.at(t), Wrench::Zero()) << t;
}

TEST(Contact, RefusesBadOptionsAllAtOnce) {
  Contact bad = pushes();
  bad.wrench[1] = std::numeric_limits<double>::quiet_NaN();
  bad.start = -1.0;
  bad.ramp = 1.6;     // more than half of the duration
  bad.period = 2.0;   // shorter than a push
  bad.turn = std::numeric_limits<double>::infinity();
  FaultList faults("contact");
  faults.checkAll(bad);
  bad.check(faults);
  EXPECT_EQ(faults.faults().size(), 5u);
}

}  // namespace
}  // namespace live_stiffness
