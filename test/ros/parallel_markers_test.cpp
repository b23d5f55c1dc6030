#include "programs/parallel_markers.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "parallel/parallel_cases.h"

namespace live_stiffness {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

class ParallelMarkersTest : public ::testing::Test {
 protected:
  ParallelMarkersTest() {
    estimator_.setLengths(unevenLengths());
    style_.frame = "base";
  }
  MarkerArray draw(bool stale = false) const {
    return makeParallelMarkers(*estimator_.estimate(), estimator_.model().scene(), stale, style_, ros::Time(1.0));
  }
  static const Marker& find(const MarkerArray& array, const char* name, int id) {
    for (const Marker& marker : array.markers)
      if (marker.ns == name && marker.id == id) return marker;
    throw std::out_of_range(name);
  }
  static Vector3 vectorOf(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }

  ParallelEstimator estimator_{awkwardRobot(), ParallelOptions()};
  ParallelMarkerStyle style_;
};

TEST_F(ParallelMarkersTest, RodsStandOnTheirHolesAndReachThePlatform) {
  const MarkerArray array = draw();
  std::set<std::tuple<float, float, float>> colours;
  for (int i = 0; i < 6; ++i) {
    const Marker& rod = find(array, "rods", i);
    const ParallelRod& model = estimator_.model().scene().rods[i];
    EXPECT_NEAR((vectorOf(rod.points.front()) - model.X_BD.p).norm(), style_.tube_radius, 1e-9);
    const Vector3 end = estimator_.estimate()->solution.X_BP * model.X_PE.p;
    EXPECT_NEAR((vectorOf(rod.points.back()) - end).norm(), style_.tube_radius, 1e-6);
    colours.emplace(rod.color.r, rod.color.g, rod.color.b);
  }
  EXPECT_EQ(colours.size(), 6u) << "a colour each";
}

TEST_F(ParallelMarkersTest, EllipsoidsAreThoseOfTheTangentCompliance) {
  const MarkerArray array = draw();
  const EllipsoidPair& pair = estimator_.estimate()->ellipsoids;
  EXPECT_NEAR(find(array, "translation_ellipsoid", 0).scale.z,
              2.0 * style_.ellipsoid_scale * pair.translation.half_axes[2], 1e-12);
  EXPECT_NEAR(find(array, "rotation_ellipsoid", 0).scale.z, 2.0 * style_.rotation_scale * pair.rotation.half_axes[2],
              1e-12);
}

// Triangles from the middle to each side cover the plate once: their area is that of the hexagon.
TEST_F(ParallelMarkersTest, PlatformIsAPlateThroughTheEndsOfTheRods) {
  const ParallelScene scene = stewartGough();
  ParallelEstimator estimator(scene, ParallelOptions());
  ASSERT_TRUE(estimator.setLengths(unevenLengths()));
  const MarkerArray array = makeParallelMarkers(*estimator.estimate(), scene, false, style_, ros::Time(1.0));
  const Marker& plate = find(array, "platform", 0);
  ASSERT_EQ(plate.points.size(), 18u);
  double area = 0.0;
  for (size_t i = 0; i < plate.points.size(); i += 3)
    area += 0.5 * (vectorOf(plate.points[i + 1]) - vectorOf(plate.points[i]))
                      .cross(vectorOf(plate.points[i + 2]) - vectorOf(plate.points[i])).norm();
  const double r = 0.073;  // sectors of 8 and 112 deg in turn
  EXPECT_NEAR(area, 1.5 * r * r * (std::sin(radians(8.0)) + std::sin(radians(112.0))), 1e-9);
}

TEST_F(ParallelMarkersTest, EveryCallGivesTheSameIdsAndStaleIsGrey) {
  std::set<std::pair<std::string, int>> first, second;
  for (const Marker& marker : draw().markers) EXPECT_TRUE(first.emplace(marker.ns, marker.id).second) << marker.ns;
  const MarkerArray stale = draw(true);
  for (const Marker& marker : stale.markers) second.emplace(marker.ns, marker.id);
  EXPECT_EQ(first, second);
  EXPECT_EQ(find(stale, "rods", 5).color.r, find(stale, "rods", 5).color.b);
  EXPECT_NE(find(stale, "text", 0).text.find("STALE"), std::string::npos);
}

}  // namespace
}  // namespace live_stiffness
