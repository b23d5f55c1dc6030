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

Marker& Picture::add(const std::string& name, int id, int type, const Color& shade) {
  Marker& marker = markers_.markers.emplace_back();
  marker.header.frame_id = frame_;
  marker.header.stamp = stamp_;
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color = shade;
  return marker;
}

void Picture::addTube(const std::string& name, int id, const std::vector<Pose>& sections, double radius,
                      const std::vector<Color>& colors) {
  constexpr int kSides = 12;
  constexpr int kCorners[6][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 0}, {0, 1}, {1, 1}};  // of the two triangles of a side
  // rviz reads the transparency of the whole marker from its own colour.
  Marker& marker = add(name, id, Marker::TRIANGLE_LIST, colors.front());
  const auto corner = [&](size_t i, int side) {
    const double angle = 2.0 * kPi * side / kSides;
    marker.points.push_back(toPoint(sections[i] * Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.0)));
    marker.colors.push_back(colors.size() > 1 ? colors[i] : colors.front());
  };
  for (size_t i = 0; i + 1 < sections.size(); ++i)
    for (int side = 0; side < kSides; ++side)
      for (const auto& [along, around] : kCorners) corner(i + along, side + around);
}

void Picture::addEllipsoid(const std::string& name, int id, const Ellipsoid& ellipsoid, const Vector3& centre,
                           double scale, const Color& shade) {
  Marker& marker = add(name, id, Marker::SPHERE, shade);
  marker.pose = toPose({ellipsoid.directions, centre});
  const auto diameter = [&](int k) {  // SPHERE's scale is the full axis
    return std::clamp(2.0 * scale * std::abs(ellipsoid.half_axes[k]), kSmallestDrawn, kLargestDrawn);
  };
  marker.scale.x = diameter(0);
  marker.scale.y = diameter(1);
  marker.scale.z = diameter(2);
}

void Picture::addBall(const std::string& name, int id, const Vector3& centre, double diameter, const Color& shade) {
  Marker& marker = add(name, id, Marker::SPHERE, shade);
  marker.pose.position = toPoint(centre);
  marker.scale.x = marker.scale.y = marker.scale.z = diameter;
}

void Picture::addArrow(const std::string& name, int id, const Vector3& from, const Vector3& to, const Color& shade) {
  if ((to - from).norm() < kSmallestDrawn) return;
  Marker& marker = add(name, id, Marker::ARROW, shade);
  marker.points = {toPoint(from), toPoint(to)};
  marker.scale.x = 0.0012;  // shaft
  marker.scale.y = 0.003;   // head
  marker.scale.z = 0.005;
}

void Picture::addLine(const std::string& name, int id, const Vector3& from, const Vector3& to, double width,
                      const Color& shade) {
  Marker& marker = add(name, id, Marker::LINE_LIST, shade);
  marker.points = {toPoint(from), toPoint(to)};
  marker.scale.x = width;
}

void Picture::addText(const std::string& name, int id, const Vector3& place, double height, const std::string& text,
                      const Color& shade) {
  Marker& marker = add(name, id, Marker::TEXT_VIEW_FACING, shade);
  marker.pose.position = toPoint(place);
  marker.scale.x = marker.scale.z = height;  // rviz reads z, viewers in web browsers x
  marker.text = text;
}

}  // namespace live_stiffness
