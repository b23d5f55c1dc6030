#include "live_stiffness/ros/markers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "live_stiffness/ros/conversions.h"

namespace live_stiffness {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kLargestDrawn = 1.0;    // m; a nearly unstable robot has an ellipsoid without bounds
constexpr double kSmallestDrawn = 1e-4;  // m; rviz refuses a scale of zero

std_msgs::ColorRGBA color(double r, double g, double b, double a) {
  std_msgs::ColorRGBA color;
  color.r = r;
  color.g = g;
  color.b = b;
  color.a = a;
  return color;
}

// Blue (0) over white to red (1).
std_msgs::ColorRGBA blueToRed(double fraction, bool stale) {
  if (stale) return color(0.6, 0.6, 0.6, 1.0);
  const double x = std::clamp(fraction, 0.0, 1.0);
  return x < 0.5 ? color(0.2 + 1.4 * x, 0.4 + x, 0.9, 1.0) : color(0.9, 0.9 - 1.4 * (x - 0.5), 0.9 - 1.4 * (x - 0.5), 1.0);
}

Marker newMarker(const MarkerStyle& style, const ros::Time& stamp, const std::string& name, int id, int type) {
  Marker marker;
  marker.header.frame_id = style.frame;
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

double largestCompliance(const Station& station) {
  return ellipsoidOf(station.compliance.topLeftCorner<3, 3>()).half_axes.z();
}

Marker tube(const std::vector<Station>& samples, bool stale, const MarkerStyle& style, const ros::Time& stamp) {
  constexpr int kSides = 12;
  Marker marker = newMarker(style, stamp, "backbone", 0, Marker::TRIANGLE_LIST);
  std::vector<double> compliance;
  for (const Station& sample : samples) compliance.push_back(largestCompliance(sample));
  const double largest = std::max(1e-12, *std::max_element(compliance.begin(), compliance.end()));
  const auto rim = [&](size_t i, int side) {
    const double angle = 2.0 * kPi * side / kSides;
    return toPoint(samples[i].X_BS *
                   Vector3(style.tube_radius * std::cos(angle), style.tube_radius * std::sin(angle), 0.0));
  };
  const auto corner = [&](size_t i, int side) {
    marker.points.push_back(rim(i, side));
    // The root spreads the colours: compliance grows with about the cube of the arc length.
    marker.colors.push_back(blueToRed(std::cbrt(compliance[i] / largest), stale));
  };
  for (size_t i = 0; i + 1 < samples.size(); ++i) {
    for (int side = 0; side < kSides; ++side) {
      corner(i, side);
      corner(i, side + 1);
      corner(i + 1, side);
      corner(i + 1, side);
      corner(i, side + 1);
      corner(i + 1, side + 1);
    }
  }
  return marker;
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

Marker ball(const MarkerStyle& style, const ros::Time& stamp, int id, const Vector3& centre,
            const std_msgs::ColorRGBA& shade) {
  Marker marker = newMarker(style, stamp, "tip", id, Marker::SPHERE);
  marker.pose.position = toPoint(centre);
  marker.scale.x = marker.scale.y = marker.scale.z = 0.004;
  marker.color = shade;
  return marker;
}

void addTips(const Vector3& predicted, const std::optional<Pose>& measured, const MarkerStyle& style,
             const ros::Time& stamp, MarkerArray& markers) {
  markers.markers.push_back(ball(style, stamp, 0, predicted, color(0.1, 0.8, 0.2, 1.0)));
  Marker seen = ball(style, stamp, 1, predicted, color(0.95, 0.1, 0.1, 1.0));
  Marker line = newMarker(style, stamp, "tip", 2, Marker::LINE_LIST);
  line.scale.x = 0.001;
  line.color = color(0.95, 0.1, 0.1, 1.0);
  if (measured) {
    seen.pose.position = toPoint(measured->p);
    line.points = {toPoint(predicted), toPoint(measured->p)};
  } else {
    seen.action = line.action = Marker::DELETE;
  }
  markers.markers.push_back(seen);
  markers.markers.push_back(line);
}

Marker eigenvalueText(const Estimate& estimate, bool stale, const MarkerStyle& style, const ros::Time& stamp) {
  Marker marker = newMarker(style, stamp, "text", 0, Marker::TEXT_VIEW_FACING);
  marker.pose.position = toPoint(estimate.solution.X_BT.p + Vector3(0.0, 0.0, 0.022));
  marker.scale.z = 0.005;
  char text[160];
  const Vector3 cm_per_n = 100.0 * estimate.tip_ellipsoid.half_axes;
  std::snprintf(text, sizeof text, "%.3g / %.3g / %.3g cm/N%s", cm_per_n[0], cm_per_n[1], cm_per_n[2],
                stale ? " STALE" : "");
  marker.text = text;
  marker.color = stale ? color(1.0, 0.3, 0.2, 1.0) : color(1.0, 1.0, 1.0, 1.0);
  return marker;
}

}  // namespace

MarkerArray makeMarkers(const Estimate& estimate, const std::vector<Station>& samples,
                        const std::optional<Pose>& measured_tip, bool stale, const MarkerStyle& style,
                        const ros::Time& stamp) {
  MarkerArray markers;
  markers.markers.push_back(tube(samples, stale, style, stamp));
  for (size_t i = 0; i < estimate.stations.size(); ++i) {
    Marker marker = newMarker(style, stamp, "ellipsoids", static_cast<int>(i), Marker::SPHERE);
    const Station& station = estimate.stations[i];
    setEllipsoid(marker, ellipsoidOf(station.compliance.topLeftCorner<3, 3>()), station.X_BS.p, style.ellipsoid_scale);
    marker.color = stale ? color(0.6, 0.6, 0.6, 0.35) : color(0.35, 0.65, 1.0, 0.6);
    markers.markers.push_back(marker);
  }
  Marker tip = newMarker(style, stamp, "tip_ellipsoid", 0, Marker::SPHERE);
  setEllipsoid(tip, estimate.tip_ellipsoid, estimate.solution.X_BT.p, style.ellipsoid_scale);
  tip.color = stale ? color(0.5, 0.5, 0.5, 0.5) : color(1.0, 0.6, 0.15, 0.75);
  markers.markers.push_back(tip);
  addTips(estimate.solution.X_BT.p, measured_tip, style, stamp, markers);
  markers.markers.push_back(eigenvalueText(estimate, stale, style, stamp));
  return markers;
}

}  // namespace live_stiffness
