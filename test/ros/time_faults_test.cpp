// Simulated time as bags make it: in a loop, paused, ten times as fast. This program is the clock.

#include <rosgraph_msgs/Clock.h>

#include "support/played_rig.h"

namespace live_stiffness {
namespace {

class TimeFaults : public PlayedRigTest {
 protected:
  TimeFaults() : clock_(node_.advertise<rosgraph_msgs::Clock>("/clock", 10)) {}

  void SetUp() override {
    PlayedRigTest::SetUp();
    ASSERT_TRUE(waitFor([&] { return clock_.getNumSubscribers() > 1; })) << "of the node and of this program";
    set(++begin_ * 1000.0);  // each test well after the one before
  }
  void set(double seconds) {
    rosgraph_msgs::Clock message;
    message.clock = ros::Time(seconds);
    clock_.publish(message);
    now_ = seconds;
  }
  // Lets time run at so many times real time, and plays the rig (or nothing) until the condition holds.
  template <class Condition>
  bool run(double speed, const Pressures* values, Condition condition) {
    ros::WallTime last = ros::WallTime::now(), published(0);
    return waitFor([&] {
      const ros::WallTime wall = ros::WallTime::now();
      set(now_ + speed * std::min(0.1, (wall - last).toSec()));
      last = wall;
      if (values != nullptr && wall - published > ros::WallDuration(0.025 / speed)) {
        published = wall;
        publishPressures(*values);
        poses_.publish(seen(*values));
      }
      return condition();
    });
  }
  bool allWell(const Pressures& values) const {
    return watched_.solvedFor(values) && is("Pressures", kOk) && is("Tracker", kOk) && is("Clock", kOk);
  }

  ros::Publisher clock_;
  double now_ = 0.0;
  static int begin_;
};

int TimeFaults::begin_ = 0;

TEST_F(TimeFaults, BagInALoop) {
  ASSERT_TRUE(run(1.0, &bent_, [&] { return allWell(bent_); })) << text("Clock") << text("Pressures") << text("Tracker");
  set(now_ - 600.0);
  const long before = watched_.estimates;
  EXPECT_TRUE(run(1.0, nullptr, [&] { return watched_.estimates > before && watched_.estimate->stale; }))
      << "before the first pressures of the new round those of the old one are stale";
  EXPECT_TRUE(run(1.0, nullptr, [&] { return is("Clock", kWarn, "jumped back"); })) << text("Clock");
  EXPECT_TRUE(run(1.0, &other_, [&] { return allWell(other_); })) << text("Clock") << text("Pressures") << text("Tracker");
  EXPECT_LE(watched_.estimate->header.stamp.toSec(), now_) << "a stamp of the new round";
}

TEST_F(TimeFaults, Pause) {
  ASSERT_TRUE(run(1.0, &bent_, [&] { return allWell(bent_); }));
  EXPECT_TRUE(run(0.0, nullptr, [&] { return is("Clock", kWarn, "stands still"); })) << text("Clock");
  EXPECT_TRUE(run(1.0, &other_, [&] { return allWell(other_); })) << text("Clock") << text("Pressures");
}

TEST_F(TimeFaults, TenTimesAsFast) {
  for (const Pressures& values : {bent_, other_, bent_}) {
    const double start = now_;
    EXPECT_TRUE(run(10.0, &values, [&] { return allWell(values) && now_ > start + 10.0; })) << text("Pressures");
    EXPECT_GE(watched_.estimate->header.stamp.toSec(), start);
  }
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "time_faults_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
