#include "ros/markers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>
#include <tuple>

#include "live_stiffness/rod/scene_file.h"
#include "ros/marker_publisher.h"

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
    return makeMarkers(estimate, Pose(), stale, style_, ros::Time(1.0));
  }
  MarkerArray draw() const { return draw(*estimator_.estimate()); }

  static const Marker& find(const MarkerArray& array, const char* name, int id) {
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

TEST_F(MarkersTest, WhatIsNotInThePictureAnyMoreIsDeletedAndTheRestReplaced) {
  using Id = std::pair<std::string, int>;
  std::set<Id> first, second, deleted;
  for (const Marker& marker : draw().markers) EXPECT_TRUE(first.emplace(marker.ns, marker.id).second) << marker.ns;
  Estimate shorter = *estimator_.estimate();
  shorter.stations.pop_back();
  ShownMarkers shown("base");
  shown.withDeletions(draw());
  // Again and again, since messages may be lost.
  for (int i = 0; i < 2; ++i) {
    const MarkerArray next =
        shown.withDeletions(makeMarkers(shorter, std::nullopt, true, style_, ros::Time(2.0)));  // without a tracker
    deleted.clear();
    second.clear();
    for (const Marker& marker : next.markers) {
      EXPECT_EQ(marker.header.frame_id, "base");
      (marker.action == Marker::DELETE ? deleted : second).emplace(marker.ns, marker.id);
    }
    EXPECT_EQ(deleted, (std::set<Id>{{"ellipsoids", 4}, {"tip", 1}, {"tip", 2}}));
  }
  second.insert(deleted.begin(), deleted.end());
  EXPECT_EQ(first, second);
  for (const Marker& marker : shown.withDeletions(draw()).markers) EXPECT_EQ(marker.action, Marker::ADD);
}

TEST_F(MarkersTest, TubeFollowsTheBackboneAndIsColouredByCompliance) {
  const MarkerArray array = draw();
  const Marker& tube = find(array, "backbone", 0);
  ASSERT_EQ(tube.points.size() % 3, 0u);
  ASSERT_EQ(tube.points.size(), tube.colors.size());
  const std::vector<Station>& samples = estimator_.estimate()->shape;
  for (const auto& point : tube.points) {
    double nearest = 1.0;
    for (const Station& sample : samples)
      nearest = std::min(nearest, (Vector3(point.x, point.y, point.z) - sample.X_BQ.p).norm());
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
  EXPECT_EQ(find(array, "text", 0).scale.x, find(array, "text", 0).scale.z) << "viewers take the height from either";
}

TEST_F(MarkersTest, EllipsoidsOfEachSegmentHaveTheirOwnColour) {
  StiffnessEstimator two(loadSceneFile(std::string(SOURCE_DIR) + "/config/scenes/paper_two_segments.yaml"),
                         ModelOptions(), EstimatorOptions());
  two.setPressures(Pressures::Constant(12, 20e3));
  const MarkerArray array = makeMarkers(*two.estimate(), std::nullopt, false, style_, ros::Time());
  std::set<std::tuple<float, float, float>> of_first, of_second;
  for (int i = 0; i < 10; ++i) {
    const auto& shade = find(array, "ellipsoids", i).color;
    (i < 5 ? of_first : of_second).emplace(shade.r, shade.g, shade.b);
  }
  EXPECT_EQ(of_first.size(), 1u);
  EXPECT_EQ(of_second.size(), 1u);
  EXPECT_NE(*of_first.begin(), *of_second.begin());
}

// The lines drawn, with eigenvalue and pitch from the labels, must add up to the stiffness: sum of k w w^T with
// k = eta / (2 h).
TEST_F(MarkersTest, EigenscrewLinesAndLabelsMakeUpTheStiffness) {
  const MarkerArray array = makeEigenscrewMarkers(*estimator_.estimate(), false, 0.08, style_, ros::Time(1.0));
  Matrix6 sum = Matrix6::Zero();
  int positive = 0;
  for (int i = 0; i < 6; ++i) {
    const Marker& line = find(array, "eigenscrews", i);
    ASSERT_EQ(line.points.size(), 2u);
    const Vector3 from(line.points[0].x, line.points[0].y, line.points[0].z),
        to(line.points[1].x, line.points[1].y, line.points[1].z);
    EXPECT_NEAR((to - from).norm(), 0.08, 1e-12);
    double eigenvalue, pitch_mm;
    const std::string& label = find(array, "eigenscrews", 6 + i).text;
    ASSERT_EQ(std::sscanf(label.c_str(), "%lf N, %lf mm/rad", &eigenvalue, &pitch_mm), 2) << label;
    positive += eigenvalue > 0.0;
    const double pitch = 1e-3 * pitch_mm;
    const Vector3 n = (to - from).normalized(), r = 0.5 * (from + to) - estimator_.estimate()->solution.X_BT.p;
    Vector6 w;
    w << n, r.cross(n) + pitch * n;
    sum += eigenvalue / (2.0 * pitch) * w * w.transpose();
  }
  EXPECT_EQ(positive, 3);
  // Labels have three digits.
  const Matrix6& K = estimator_.estimate()->stiffness;
  EXPECT_LT((sum - K).leftCols(3).topRows(3).norm(), 0.02 * K.leftCols(3).topRows(3).norm());
}

TEST_F(MarkersTest, ThereAreNoEigenscrewsWhenStaleOrWithoutAnyToShow) {
  Estimate indefinite = *estimator_.estimate();
  indefinite.stiffness(0, 0) = -1.0;
  for (const MarkerArray& array : {makeEigenscrewMarkers(*estimator_.estimate(), true, 0.08, style_, ros::Time()),
                                   makeEigenscrewMarkers(indefinite, false, 0.08, style_, ros::Time())})
    EXPECT_TRUE(array.markers.empty());
}

TEST_F(MarkersTest, GhostHasAShapeAnArrowAsLongAsTheForceAndAText) {
  Ghost ghost;
  ghost.X_BT.p = Vector3(0.01, 0.02, 0.03);
  ghost.shape = {Pose(), ghost.X_BT};
  ghost.force = Vector3(0.0, 0.4, 0.0);
  ghost.text = "0.4 N";
  const MarkerArray array = makeGhostMarkers(ghost, 20.0, style_, ros::Time());
  const Marker& arrow = find(array, "ghost_force", 0);
  ASSERT_EQ(arrow.points.size(), 2u);
  EXPECT_NEAR(arrow.points[1].y - arrow.points[0].y, 0.02, 1e-12) << "0.4 N at 20 N/m";
  EXPECT_EQ(find(array, "ghost", 0).action, Marker::ADD);
  EXPECT_LT(find(array, "ghost", 0).color.a, 1.0) << "a ghost lets the robot shine through";
  EXPECT_EQ(find(array, "ghost_text", 0).text, "0.4 N");
}

TEST_F(MarkersTest, ContactIsAnArrowThatEndsAtTheTipWithItsSize) {
  const Vector3 tip(0.01, 0.0, 0.04), force(0.3, 0.0, -0.4);
  const MarkerArray touched = makeContactMarkers(tip, force, 0.03, 20.0, style_, ros::Time());
  const Marker& arrow = find(touched, "contact", 0);
  ASSERT_EQ(arrow.points.size(), 2u);
  EXPECT_EQ(arrow.points[1].x, tip.x());
  EXPECT_NEAR(arrow.points[1].z - arrow.points[0].z, -0.02, 1e-12) << "-0.4 N at 20 N/m";
  EXPECT_EQ(find(touched, "contact", 1).text, "0.50 +- 0.03 N");
  const MarkerArray huge = makeContactMarkers(tip, 1e6 * force, 0.03, 20.0, style_, ros::Time());
  EXPECT_LT(std::abs(find(huge, "contact", 0).points[0].z), 0.3) << "kept within what can be drawn";
}

TEST_F(MarkersTest, GhostWithoutAnEquilibriumIsATextAlone) {
  Ghost ghost;
  ghost.text = "no stable equilibrium there";
  const MarkerArray refused = makeGhostMarkers(ghost, 20.0, style_, ros::Time());
  ASSERT_EQ(refused.markers.size(), 1u);
  EXPECT_EQ(refused.markers[0].text, ghost.text);
}

}  // namespace
}  // namespace live_stiffness
