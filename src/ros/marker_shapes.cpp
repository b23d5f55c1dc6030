#include "ros/marker_shapes.h"

#include <algorithm>
#include <cmath>

#include "ros/conversions.h"

namespace live_stiffness {
namespace {

using visualization_msgs::Marker;

constexpr double kLargestDrawn = 1.0;    // m; the ellipsoid of a nearly unstable robot has no limit
constexpr double kSmallestDrawn = 1e-4;  // m; rviz refuses a scale of zero

}  // namespace

std_msgs::ColorRGBA color(double r, double g, double b, double a) {
  std_msgs::ColorRGBA color;
  color.r = r;
  color.g = g;
  color.b = b;
  color.a = a;
  return color;
}

std_msgs::ColorRGBA blueToRed(double fraction, bool stale) {
  if (stale) return color(0.6, 0.6, 0.6, 1.0);
  const double x = std::clamp(fraction, 0.0, 1.0);
  if (x < 0.5) return color(0.2 + 1.4 * x, 0.4 + x, 0.9, 1.0);
  return color(0.9, 0.9 - 1.4 * (x - 0.5), 0.9 - 1.4 * (x - 0.5), 1.0);
}

Marker newMarker(const std::string& frame, const ros::Time& stamp, const std::string& name, int id, int type) {
  Marker marker;
  marker.header.frame_id = frame;
  marker.header.stamp = stamp;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color = color(1.0, 1.0, 1.0, 1.0);
  return marker;
}

void setTube(Marker& marker, const std::vector<Pose>& sections, double radius,
             const std::vector<std_msgs::ColorRGBA>& colors) {
  constexpr int kSides = 12;
  marker.type = Marker::TRIANGLE_LIST;
  marker.color = colors.front();  // rviz reads the transparency of the whole marker from here
  const auto corner = [&](size_t i, int side) {
    const double angle = 2.0 * kPi * side / kSides;
    marker.points.push_back(toPoint(sections[i] * Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.0)));
    marker.colors.push_back(colors.size() > 1 ? colors[i] : colors.front());
  };
  for (size_t i = 0; i + 1 < sections.size(); ++i) {
    for (int side = 0; side < kSides; ++side) {
      corner(i, side);
      corner(i, side + 1);
      corner(i + 1, side);
      corner(i + 1, side);
      corner(i, side + 1);
      corner(i + 1, side + 1);
    }
  }
}

void setEllipsoid(Marker& marker, const Ellipsoid& ellipsoid, const Vector3& centre, double scale) {
  marker.pose = toPose({ellipsoid.directions, centre});
  const auto diameter = [&](int k) {  // SPHERE's scale is the full axis
    return std::clamp(2.0 * scale * std::abs(ellipsoid.half_axes[k]), kSmallestDrawn, kLargestDrawn);
  };
  marker.scale.x = diameter(0);
  marker.scale.y = diameter(1);
  marker.scale.z = diameter(2);
}

void setBall(Marker& marker, const Vector3& centre, double diameter, const std_msgs::ColorRGBA& shade) {
  marker.pose.position = toPoint(centre);
  marker.scale.x = marker.scale.y = marker.scale.z = diameter;
  marker.color = shade;
}

void setArrow(Marker& marker, const Vector3& from, const Vector3& to, const std_msgs::ColorRGBA& shade) {
  marker.type = Marker::ARROW;
  marker.points = {toPoint(from), toPoint(to)};
  marker.scale.x = 0.0012;  // shaft
  marker.scale.y = 0.003;   // head
  marker.scale.z = 0.005;
  marker.color = shade;
  if ((to - from).norm() < kSmallestDrawn) marker.action = Marker::DELETE;
}

void setText(Marker& marker, const Vector3& place, double height, const std::string& text) {
  marker.type = Marker::TEXT_VIEW_FACING;
  marker.pose.position = toPoint(place);
  marker.scale.z = height;
  marker.text = text;
}

void deleteAll(visualization_msgs::MarkerArray& markers) {
  for (Marker& marker : markers.markers) marker.action = Marker::DELETE;
}

}  // namespace live_stiffness
