// demo.launch: the simulated rig and the node that watches it. Parameter ~max_mean_error_m.

#include <gtest/gtest.h>

#include "live_stiffness/estimation/error_summary.h"
#include "ros/conversions.h"
#include "support/estimate_checks.h"
#include "support/ros_wait.h"

namespace live_stiffness {
namespace {

TEST(Demo, NodeTracksTheSimulatedRig) {
  ros::NodeHandle node;
  double max_mean_error;
  int chambers;
  ASSERT_TRUE(ros::NodeHandle("~").getParam("max_mean_error_m", max_mean_error) &&
              ros::NodeHandle("~").getParam("chambers", chambers));
  std::vector<double> distances;
  bool always_good = true, has_bent = false;
  geometry_msgs::PoseStamped::ConstPtr truth;
  double truth_distance = 1.0;
  const auto subscribers = {
      node.subscribe<geometry_msgs::PoseStamped>("/rig_simulator/true_tip_pose", 10,
                                                 [&](const geometry_msgs::PoseStamped::ConstPtr& m) { truth = m; }),
      node.subscribe<StiffnessEstimate>("/stiffness_node/estimate", 100, [&](const StiffnessEstimate::ConstPtr& m) {
        always_good = always_good && isFinite(*m) && m->status == StiffnessEstimate::OK &&
                      static_cast<int>(m->pressure.size()) == chambers;
        for (double pressure : m->pressure) has_bent = has_bent || pressure > 30e3;
        if (truth) truth_distance = (positionOf(truth->pose) - positionOf(m->tip_pose)).norm();
      }),
      node.subscribe<TrackingError>("/stiffness_node/tracking_error", 100, [&](const TrackingError::ConstPtr& m) {
        distances.push_back(m->distance);
      })};
  ASSERT_TRUE(waitFor([&] { return distances.size() > 150 && has_bent; }, 60.0))
      << distances.size() << " tracking errors from " << subscribers.size() << " topics";
  EXPECT_TRUE(always_good);
  const ErrorSummary summary = summarizeErrors(distances);
  std::printf("tip error %s\n", millimetreText(summary).c_str());
  EXPECT_LT(summary.mean, max_mean_error);
  EXPECT_GT(summary.mean, 1e-5) << "the simulated tracker must be noisy";
  EXPECT_LT(truth_distance, 5 * max_mean_error);
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "demo_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
