// A bag played through the node by replay.launch in simulated time: tip error, rates and stamps of what comes out.
// Parameters: ~bag, ~channel_of_chamber, ~max_mean_error_m, ~update_threshold_pa.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <rosgraph_msgs/Clock.h>

#include <map>

#include "live_stiffness/estimation/error_summary.h"
#include "ros/conversions.h"
#include "live_stiffness/section/channel_map.h"
#include "support/estimate_checks.h"
#include "support/ros_wait.h"

namespace live_stiffness {
namespace {

struct Recorded {
  std::map<ros::Time, Pressures> pressures;  // chamber pressures by stamp
  std::map<ros::Time, geometry_msgs::PoseStamped> poses;
  ros::Time end;
};

Recorded readBag(const std::string& path, const ChannelMap& channels) {
  Recorded recorded;
  rosbag::Bag bag(path);
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
    if (const auto message = instance.instantiate<ChamberPressures>())
      recorded.pressures[message->header.stamp] =
          channels.expand(Eigen::VectorXd::Map(message->pressure.data(), message->pressure.size()));
    if (const auto message = instance.instantiate<geometry_msgs::PoseStamped>())
      recorded.poses[message->header.stamp] = *message;
    recorded.end = std::max(recorded.end, instance.getTime());
  }
  return recorded;
}

TEST(Replay, EveryPressureIsAnsweredWithinTheThresholdByAnEstimateWithItsStamp) {
  ros::NodeHandle node, private_node("~");
  std::string path;
  std::vector<int> channel_of_chamber;
  double max_mean_error, threshold;
  ASSERT_TRUE(private_node.getParam("bag", path) && private_node.getParam("channel_of_chamber", channel_of_chamber) &&
              private_node.getParam("max_mean_error_m", max_mean_error) &&
              private_node.getParam("update_threshold_pa", threshold));
  const Recorded recorded = readBag(path, ChannelMap(channel_of_chamber));
  ASSERT_GT(recorded.pressures.size(), 100u);

  std::vector<StiffnessEstimate::ConstPtr> estimates;
  std::vector<TrackingError::ConstPtr> errors;
  ros::Time clock;
  const auto subscribers = {
      node.subscribe<StiffnessEstimate>("/stiffness_node/estimate", 10000,
                                        [&](const StiffnessEstimate::ConstPtr& m) { estimates.push_back(m); }),
      node.subscribe<TrackingError>("/stiffness_node/tracking_error", 10000,
                                    [&](const TrackingError::ConstPtr& m) { errors.push_back(m); }),
      node.subscribe<rosgraph_msgs::Clock>("/clock", 10, [&](const rosgraph_msgs::Clock::ConstPtr& m) {
        clock = std::max(clock, m->clock);
      })};
  // The heartbeat publishes the last pressures again; with it all of the bag has been answered.
  ASSERT_TRUE(waitFor(
      [&] {
        return clock >= recorded.end - ros::Duration(0.1) && !estimates.empty() &&
               estimates.back()->header.stamp >= recorded.pressures.rbegin()->first - ros::Duration(0.2) &&
               !errors.empty() && errors.back()->header.stamp >= recorded.poses.rbegin()->first - ros::Duration(0.2);
      },
      150.0))
      << "clock at " << clock << " of " << recorded.end << ", " << estimates.size() << " estimates";
  EXPECT_EQ(subscribers.size(), 3u);

  // Stamps: each is that of a recorded pressure message with just these pressures, and they never go back.
  std::map<ros::Time, StiffnessEstimate::ConstPtr> by_stamp;
  for (const auto& estimate : estimates) {
    ASSERT_TRUE(isFinite(*estimate));
    EXPECT_EQ(estimate->status, StiffnessEstimate::OK) << estimate->message;
    const auto source = recorded.pressures.find(estimate->header.stamp);
    ASSERT_NE(source, recorded.pressures.end()) << "no pressures with stamp " << estimate->header.stamp;
    EXPECT_EQ(Pressures::Map(estimate->pressure.data(), estimate->pressure.size()), source->second);
    if (!by_stamp.empty()) {
      EXPECT_GE(estimate->header.stamp, by_stamp.rbegin()->first);
    }
    by_stamp[estimate->header.stamp] = estimate;
  }
  // Rates: whatever the moment, the newest estimate is within the threshold of the pressures. The first messages may
  // pass before this test has subscribed.
  long checked = 0;
  for (const auto& [stamp, pressures] : recorded.pressures) {
    auto newest = by_stamp.upper_bound(stamp);
    if (newest == by_stamp.begin() || stamp > by_stamp.rbegin()->first) continue;
    const auto& used = std::prev(newest)->second->pressure;
    EXPECT_LE((Pressures::Map(used.data(), used.size()) - pressures).norm(), threshold) << "at " << stamp;
    ++checked;
  }
  EXPECT_GT(checked, 0.9 * recorded.pressures.size()) << "most of the bag must have been answered";

  // Tip error: stamps are those of recorded poses.
  std::vector<double> distances;
  for (const auto& error : errors) {
    EXPECT_EQ(recorded.poses.count(error->header.stamp), 1u);
    ASSERT_TRUE(std::isfinite(error->distance));
    distances.push_back(error->distance);
  }
  size_t measured = 0;  // a pose that repeats the one before is no measurement
  geometry_msgs::Pose last;
  for (const auto& [stamp, pose] : recorded.poses) {
    measured += pose.pose != last;
    last = pose.pose;
  }
  EXPECT_GT(distances.size(), 0.8 * static_cast<double>(measured));
  const ErrorSummary summary = summarizeErrors(distances);
  std::printf("tip error %s; %zu estimates for %zu pressures\n", millimetreText(summary).c_str(), estimates.size(),
              recorded.pressures.size());
  EXPECT_LT(summary.mean, max_mean_error);
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "replay_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
