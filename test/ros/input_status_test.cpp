#include "ros/input_status.h"

#include <gtest/gtest.h>

namespace live_stiffness {
namespace {

const ros::Time kNow(1000.0);

TEST(InputStatus, KeepsAStampNearRosTimeAndReplacesADevicesClock) {
  InputStatus status("input");
  EXPECT_EQ(status.accept(ros::Time(999.5), kNow), ros::Time(999.5));
  EXPECT_EQ(status.warning(), "");
  EXPECT_EQ(status.accept(ros::Time(), kNow), kNow) << "no stamp at all";
  EXPECT_EQ(status.warning(), "");
  EXPECT_EQ(status.accept(ros::Time(12.0), kNow), kNow) << "seconds since the device was switched on";
  EXPECT_NE(status.warning().find("behind"), std::string::npos) << status.warning();
}

// The difference of two ros::Time throws beyond 68 years.
TEST(InputStatus, ReplacesAStampThatIsGarbage) {
  for (uint32_t garbage : {4000000000u, 4294967295u}) {
    InputStatus status("input");
    EXPECT_EQ(status.accept(ros::Time(garbage, 0), kNow), kNow);
    EXPECT_NE(status.warning().find("ahead"), std::string::npos) << status.warning();
    EXPECT_EQ(status.accept(kNow, kNow), kNow);
  }
}

// In a replay the first message may arrive before the first /clock, when ROS time is still zero.
TEST(InputStatus, KeepsTheStampWhileSimulatedTimeHasNotBegun) {
  InputStatus status("input");
  EXPECT_EQ(status.accept(kNow, ros::Time()), kNow);
  EXPECT_EQ(status.warning(), "");
}

TEST(InputStatus, ErrorLastsUntilTheNextGoodMessage) {
  InputStatus status("input");
  EXPECT_FALSE(status.hasMessage());
  EXPECT_GT(status.age(ros::Time(5.0)), 1e6);
  status.reject("bad");
  EXPECT_EQ(status.error(), "bad");
  status.accept(ros::Time(), ros::Time(10.0));
  EXPECT_TRUE(status.error().empty());
  EXPECT_NEAR(status.age(ros::Time(10.5)), 0.5, 1e-9);
}

TEST(InputStatus, ReplacesAStampOfTheFutureAndForgetsThatItWasOne) {
  InputStatus status("input");
  EXPECT_EQ(status.accept(ros::Time(1000.4), kNow), ros::Time(1000.4));
  EXPECT_EQ(status.accept(ros::Time(1003.0), kNow), kNow);
  EXPECT_NE(status.warning().find("ahead"), std::string::npos) << status.warning();
  status.accept(ros::Time(1003.1), ros::Time(1003.2));
  EXPECT_EQ(status.warning(), "");
}

TEST(InputStatus, LeavesOutWhatWasOvertakenButNotAClockThatWasSet) {
  InputStatus status("input");
  EXPECT_TRUE(status.accept(ros::Time(1000.0), kNow));
  EXPECT_FALSE(status.accept(ros::Time(999.9), kNow));
  EXPECT_NE(status.warning().find("out of order"), std::string::npos) << status.warning();
  EXPECT_TRUE(status.accept(ros::Time(1000.0), kNow)) << "a stamp that is coarse";
  EXPECT_TRUE(status.accept(ros::Time(900.0), kNow)) << "a driver that began again";
  EXPECT_TRUE(status.accept(ros::Time(), kNow)) << "no stamp, no order";
}

TEST(InputStatus, AgeIsThatOfTheStampAndVeryLargeAfterTimeJumpedBack) {
  InputStatus status("input");
  status.accept(ros::Time(997.0), kNow);
  EXPECT_NEAR(status.age(ros::Time(1000.1)), 3.1, 1e-9);
  EXPECT_GT(status.age(ros::Time(500.0)), 1e6);
  status.checkClock(ros::Time(500.0));
  EXPECT_FALSE(status.hasMessage());
  EXPECT_GT(status.age(ros::Time(1000.1)), 1e6) << "not fresh again once time has come round";
}

TEST(InputStatus, CountsTheMessagesLostBetweenTwoOfOnePublisher) {
  InputStatus status("input");
  status.countLost("/driver", 7);
  status.countLost("/driver", 8);
  EXPECT_EQ(status.newlyLost(), 0);
  status.countLost("/driver", 12);
  EXPECT_EQ(status.newlyLost(), 3);
  status.countLost("/driver", 1);    // restarted
  status.countLost("/other", 50);    // another one has its own numbers
  status.countLost("/driver", 100);
  status.countLost("/driver", 100);  // one that does not number its messages
  EXPECT_EQ(status.newlyLost(), 0);
}

TEST(ArrayStatus, RefusesAnotherNumberOfValuesByName) {
  ArrayStatus status({"pressures", "pressures", "channels", "; see channel_of_chamber", 2, 0.5});
  Parsed<Eigen::VectorXd> three{ros::Time(), Eigen::VectorXd::Zero(3), ""}, two{ros::Time(), Eigen::VectorXd::Zero(2), ""};
  ros::Time::init();
  EXPECT_FALSE(status.accept(three, "/driver"));
  EXPECT_EQ(status.error(), "3 channels: must be 2; see channel_of_chamber");
  EXPECT_TRUE(status.isStale());
  EXPECT_TRUE(status.accept(two, "/driver"));
  EXPECT_FALSE(two.stamp.isZero()) << "without a stamp the time of arrival";
  EXPECT_FALSE(status.isStale());
}

}  // namespace
}  // namespace live_stiffness
