#include "live_stiffness/ros/markers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

class MarkersTest : public ::testing::Test {
 protected:
  MarkersTest() {
    Pressures pressures(6);
    pressures << 90e3, 90e3, 0.0, 0.0, 30e3, 30e3;
    estimator_.setPressures(pressures);
    style_.frame = "base";
  }

  MarkerArray draw(const Estimate& estimate, bool stale = false) const {
    return makeMarkers(estimate, estimator_.sampleBackbone(10), Pose(), stale, style_, ros::Time(1.0));
  }
  MarkerArray draw() const { return draw(*estimator_.estimate()); }

  static const Marker& find(const MarkerArray& array, const std::string& name, int id) {
    for (const Marker& marker : array.markers)
      if (marker.ns == name && marker.id == id) return marker;
    throw std::out_of_range(name);
  }

  StiffnessEstimator estimator_{loadSceneFile(std::string(SOURCE_DIR) + "/config/scenes/paper_one_segment.yaml"),
                                ModelOptions(), EstimatorOptions()};
  MarkerStyle style_;
};

TEST_F(MarkersTest, TipEllipsoidHasTheFullAxesOfTheTangentCompliance) {
  const MarkerArray array = draw();
  const Marker& marker = find(array, "tip_ellipsoid", 0);
  const Vector3 axes = estimator_.estimate()->tip_ellipsoid.half_axes;
  EXPECT_NEAR(marker.scale.x, 2.0 * style_.ellipsoid_scale * axes[0], 1e-15);
  EXPECT_NEAR(marker.scale.z, 2.0 * style_.ellipsoid_scale * axes[2], 1e-15);
  // The orientation turns a diagonal matrix of the axes into the block itself.
  const auto& q = marker.pose.orientation;
  const Matrix3 R = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  const Matrix3 block = estimator_.estimate()->solution.compliance.topLeftCorner<3, 3>();
  EXPECT_LT((R * axes.asDiagonal() * R.transpose() - block).norm(), 1e-12 * block.norm());
}

TEST_F(MarkersTest, EveryCallGivesTheSameIdsSoThatMarkersReplaceOneAnother) {
  std::set<std::pair<std::string, int>> first, second;
  for (const Marker& marker : draw().markers) EXPECT_TRUE(first.emplace(marker.ns, marker.id).second) << marker.ns;
  const MarkerArray without_tracker = makeMarkers(*estimator_.estimate(), estimator_.sampleBackbone(10), std::nullopt,
                                                  true, style_, ros::Time(2.0));
  for (const Marker& marker : without_tracker.markers) second.emplace(marker.ns, marker.id);
  EXPECT_EQ(first, second);
  EXPECT_EQ(find(without_tracker, "tip", 1).action, Marker::DELETE) << "no measured tip without a tracker";
}

TEST_F(MarkersTest, TubeFollowsTheBackboneAndIsColouredByCompliance) {
  const MarkerArray array = draw();
  const Marker& tube = find(array, "backbone", 0);
  ASSERT_EQ(tube.points.size() % 3, 0u);
  ASSERT_EQ(tube.points.size(), tube.colors.size());
  const std::vector<Station> samples = estimator_.sampleBackbone(10);
  for (const auto& point : tube.points) {
    double nearest = 1.0;
    for (const Station& sample : samples)
      nearest = std::min(nearest, (Vector3(point.x, point.y, point.z) - sample.X_BS.p).norm());
    EXPECT_NEAR(nearest, style_.tube_radius, 1e-9);
  }
  EXPECT_GT(tube.colors.front().b, tube.colors.front().r) << "blue at the stiff base";
  EXPECT_GT(tube.colors.back().r, tube.colors.back().b) << "red at the soft tip";
}

TEST_F(MarkersTest, ExtremeCompliancesStayDrawable) {
  Estimate estimate = *estimator_.estimate();
  estimate.tip_ellipsoid.half_axes = Vector3(-1e-30, 0.0, 1e13);  // unstable, rigid and nearly singular at once
  const MarkerArray array = draw(estimate);
  for (const Marker& marker : array.markers) {
    for (double size : {marker.scale.x, marker.scale.y, marker.scale.z}) {
      EXPECT_GT(size, 0.0);
      EXPECT_LE(size, 1.0);
    }
  }
}

TEST_F(MarkersTest, StaleIsGreyAndSaysSo) {
  const MarkerArray array = draw(*estimator_.estimate(), true);
  const auto& color = find(array, "tip_ellipsoid", 0).color;
  EXPECT_EQ(color.r, color.b);
  EXPECT_NE(find(array, "text", 0).text.find("STALE"), std::string::npos);
}

}  // namespace
}  // namespace live_stiffness
