#include "programs/parallel_markers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ros/conversions.h"

namespace live_stiffness {
namespace {

// A plate through points in their order around their mean.
void addPlate(const std::string& name, std::vector<Vector3> corners, const std_msgs::ColorRGBA& shade, Picture& picture) {
  visualization_msgs::Marker& marker = picture.add(name, 0, visualization_msgs::Marker::TRIANGLE_LIST, shade);
  Vector3 centre = Vector3::Zero();
  for (const Vector3& corner : corners) centre += corner / corners.size();
  // Around the mean, in the plane of the first corner and the one farthest from the line through it.
  const Vector3 x = (corners.front() - centre).normalized();
  Vector3 y = Vector3::Zero();
  for (const Vector3& corner : corners) {
    const Vector3 across = (corner - centre) - x.dot(corner - centre) * x;
    if (across.norm() > y.norm()) y = across;
  }
  std::sort(corners.begin(), corners.end(), [&](const Vector3& a, const Vector3& b) {
    return std::atan2(y.dot(a - centre), y.norm() * x.dot(a - centre)) <
           std::atan2(y.dot(b - centre), y.norm() * x.dot(b - centre));
  });
  for (size_t i = 0; i < corners.size(); ++i)
    for (const Vector3& corner : {centre, corners[i], corners[(i + 1) % corners.size()]})
      marker.points.push_back(toPoint(corner));
  marker.colors.assign(marker.points.size(), shade);  // a colour of its own for each point is drawn without light
}

std::string eigenvalueText(const ParallelEstimate& estimate, bool stale) {
  const Vector3 &c = estimate.ellipsoids.translation.half_axes, &r = estimate.ellipsoids.rotation.half_axes;
  char text[200];
  std::snprintf(text, sizeof text, "%.3g / %.3g / %.3g mm/N\n%.3g / %.3g / %.3g deg/(N m)%s", 1e3 * c[0], 1e3 * c[1],
                1e3 * c[2], degrees(r[0]), degrees(r[1]), degrees(r[2]), stale ? " STALE" : "");
  return text;
}

}  // namespace

visualization_msgs::MarkerArray makeParallelMarkers(const ParallelEstimate& estimate, const ParallelScene& scene, bool stale,
                                                    const ParallelMarkerStyle& style, const ros::Time& stamp) {
  Picture picture(style.frame, stamp);
  const Pose& X_BP = estimate.solution.X_BP;
  std::vector<Vector3> holes, ends;
  for (size_t i = 0; i < estimate.rods.size(); ++i) {
    holes.push_back(scene.rods[i].X_BD.p);
    ends.push_back(X_BP * scene.rods[i].X_PE.p);
    const double share = i / std::max(1.0, estimate.rods.size() - 1.0);
    picture.addTube("rods", static_cast<int>(i), estimate.rods[i],
                    std::max(style.tube_radius, scene.rods[i].section.outer_radius), {blueToRed(share, stale)});
  }
  addPlate("base", holes, color(0.45, 0.45, 0.5), picture);
  addPlate("platform", ends, stale ? color(0.6, 0.6, 0.6, 0.8) : color(0.3, 0.75, 0.55, 0.8), picture);
  picture.addEllipsoid("translation_ellipsoid", 0, estimate.ellipsoids.translation, X_BP.p, style.ellipsoid_scale,
                       stale ? color(0.5, 0.5, 0.5, 0.5) : color(1.0, 0.6, 0.15, 0.75));
  picture.addEllipsoid("rotation_ellipsoid", 0, estimate.ellipsoids.rotation, X_BP.p, style.rotation_scale,
                       stale ? color(0.6, 0.6, 0.6, 0.35) : color(0.35, 0.65, 1.0, 0.5));
  picture.addText("text", 0, X_BP.p + Vector3(0.0, 0.0, 0.09), 0.02, eigenvalueText(estimate, stale),
                  stale ? color(1.0, 0.3, 0.2) : color(1.0, 1.0, 1.0));
  return picture.markers();
}

}  // namespace live_stiffness
