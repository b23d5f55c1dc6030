#include "estimation/motion_history.h"

#include <gtest/gtest.h>

namespace live_stiffness {
namespace {

Moment moment(double time) {
  return {time, Pressures::Constant(2, 1e3 * time), {expSo3(Vector3(0.1 * time, 0.0, 0.0)), Vector3(time, 0.0, 0.0)}};
}

TEST(MotionHistory, InterpolatesBetweenMomentsAndKeepsToItsEnds) {
  MotionHistory history;
  EXPECT_TRUE(history.empty());
  for (double time : {10.0, 10.1, 10.3}) history.add(moment(time));
  for (const auto& [asked, time] : {std::pair(9.0, 10.0), std::pair(10.05, 10.05), std::pair(10.25, 10.25),
                                    std::pair(10.3, 10.3), std::pair(12.0, 10.3)}) {
    const Moment found = history.at(asked);
    EXPECT_NEAR(found.pressures[1], 1e3 * time, 1e-9);
    EXPECT_NEAR(found.X_BT.p.x(), time, 1e-12);
    EXPECT_LT((found.X_BT.R - moment(time).X_BT.R).norm(), 1e-12);
  }
}

TEST(MotionHistory, ForgetsWhatIsOldAndBeginsAnewWhenTheClockIsSetBack) {
  MotionHistory history;
  for (int k = 0; k <= 100; ++k) history.add(moment(0.1 * k));
  EXPECT_NEAR(history.at(0.0).time, 10.0 - MotionHistory::kCapacity, 1e-9);
  history.add(moment(9.95));  // late: left out
  EXPECT_NEAR(history.at(20.0).time, 10.0, 1e-12);
  history.add(moment(3.0));
  EXPECT_EQ(history.at(20.0).time, 3.0);
}

TEST(MotionHistory, IsBoundedHoweverQuicklyMomentsCome) {
  MotionHistory history;
  for (int k = 0; k < 10000; ++k) history.add(moment(1.0 + 1e-6 * k));
  EXPECT_NEAR(history.at(0.0).time, 1.0 + 1e-6 * (10000 - static_cast<double>(MotionHistory::kMost)), 1e-9);
}

}  // namespace
}  // namespace live_stiffness
