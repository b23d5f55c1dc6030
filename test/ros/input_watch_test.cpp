#include "ros/input_watch.h"

#include <gtest/gtest.h>

namespace live_stiffness {
namespace {

TEST(InputWatch, KeepsAStampNearRosTimeAndReplacesADevicesClock) {
  InputWatch watch("input");
  const ros::Time now(1000.0);
  EXPECT_EQ(watch.stampFor(ros::Time(999.5), now), ros::Time(999.5));
  EXPECT_EQ(watch.foreignStamps(), 0);
  EXPECT_EQ(watch.stampFor(ros::Time(), now), now) << "no stamp at all";
  EXPECT_EQ(watch.foreignStamps(), 0);
  EXPECT_EQ(watch.stampFor(ros::Time(12.0), now), now) << "seconds since the device was switched on";
  EXPECT_EQ(watch.foreignStamps(), 1);
}

// In a replay the first message may arrive before the first /clock, when ROS time is still zero.
TEST(InputWatch, KeepsTheStampWhileSimulatedTimeHasNotBegun) {
  InputWatch watch("input");
  EXPECT_EQ(watch.stampFor(ros::Time(1000.0), ros::Time()), ros::Time(1000.0));
  EXPECT_EQ(watch.foreignStamps(), 0);
}

TEST(InputWatch, FaultLastsUntilTheNextGoodMessage) {
  InputWatch watch("input");
  EXPECT_FALSE(watch.everAccepted());
  EXPECT_GT(watch.age(ros::Time(5.0)), 1e6);
  watch.reject("bad");
  EXPECT_EQ(watch.currentFault(), "bad");
  watch.accept(ros::Time(10.0));
  EXPECT_TRUE(watch.currentFault().empty());
  EXPECT_NEAR(watch.age(ros::Time(10.5)), 0.5, 1e-9);
}

TEST(InputWatch, ReplacesAStampOfTheFutureAndForgetsThatItWasOne) {
  InputWatch watch("input");
  const ros::Time now(1000.0);
  EXPECT_EQ(watch.stampFor(ros::Time(1000.4), now), ros::Time(1000.4));
  EXPECT_EQ(watch.stampFor(ros::Time(1003.0), now), now);
  EXPECT_NE(watch.oddity().find("ahead"), std::string::npos) << watch.oddity();
  watch.stampFor(ros::Time(999.9), now);
  EXPECT_EQ(watch.oddity(), "");
}

TEST(InputWatch, LeavesOutWhatWasOvertakenButNotAClockThatWasSet) {
  InputWatch watch("input");
  EXPECT_TRUE(watch.arrivesInOrder(ros::Time(1000.0)));
  EXPECT_FALSE(watch.arrivesInOrder(ros::Time(999.9)));
  EXPECT_FALSE(watch.oddity().empty());
  EXPECT_TRUE(watch.arrivesInOrder(ros::Time(1000.0))) << "a stamp that is coarse";
  EXPECT_TRUE(watch.arrivesInOrder(ros::Time(900.0))) << "a driver that began again";
  EXPECT_TRUE(watch.arrivesInOrder(ros::Time())) << "no stamp, no order";
}

TEST(InputWatch, AgeIsThatOfTheStampAndOfNothingAfterTimeJumpedBack) {
  InputWatch watch("input");
  watch.accept(ros::Time(1000.0), ros::Time(997.0));
  EXPECT_NEAR(watch.age(ros::Time(1000.1)), 3.1, 1e-9);
  EXPECT_GT(watch.age(ros::Time(500.0)), 1e6);
  watch.notice(ros::Time(500.0));
  EXPECT_FALSE(watch.everAccepted());
  EXPECT_GT(watch.age(ros::Time(1000.1)), 1e6) << "not fresh again once time has come round";
}

TEST(InputWatch, CountsTheMessagesLostBetweenTwoOfOnePublisher) {
  InputWatch watch("input");
  watch.number("/driver", 7);
  watch.number("/driver", 8);
  EXPECT_EQ(watch.lost(), 0);
  watch.number("/driver", 12);
  EXPECT_EQ(watch.lost(), 3);
  watch.number("/driver", 1);    // restarted
  watch.number("/other", 50);    // another one has its own numbers
  watch.number("/driver", 100);
  watch.number("/driver", 100);  // one that does not number its messages
  EXPECT_EQ(watch.lost(), 3);
}

}  // namespace
}  // namespace live_stiffness
