#include "ros/markers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "live_stiffness/analysis/eigenscrews.h"
#include "ros/conversions.h"

namespace live_stiffness {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

double largestCompliance(const Station& station) {
  return ellipsoidOf(station.compliance.topLeftCorner<3, 3>()).half_axes.z();
}

Marker tube(const std::vector<Station>& shape, bool stale, const MarkerStyle& style, const ros::Time& stamp) {
  std::vector<Pose> sections;
  std::vector<double> compliance;
  for (const Station& station : shape) {
    sections.push_back(station.X_BQ);
    compliance.push_back(largestCompliance(station));
  }
  const double largest = std::max(1e-12, *std::max_element(compliance.begin(), compliance.end()));
  std::vector<std_msgs::ColorRGBA> colors;
  colors.reserve(compliance.size());
  // Cube root, since compliance grows with about the cube of the arc length.
  for (double value : compliance) colors.push_back(blueToRed(std::cbrt(value / largest), stale));
  Marker marker = newMarker(style.frame, stamp, "backbone", 0, Marker::TRIANGLE_LIST);
  setTube(marker, sections, style.tube_radius, colors);
  return marker;
}

// Of the segments in turn: blue, green, violet, yellow, and again.
std_msgs::ColorRGBA segmentColor(size_t segment, bool stale) {
  if (stale) return color(0.6, 0.6, 0.6, 0.35);
  const std_msgs::ColorRGBA palette[] = {color(0.35, 0.65, 1.0, 0.6), color(0.4, 0.85, 0.4, 0.6),
                                         color(0.75, 0.5, 1.0, 0.6), color(0.95, 0.9, 0.35, 0.6)};
  return palette[segment % 4];
}

void addTips(const Vector3& predicted, const std::optional<Pose>& measured, const MarkerStyle& style,
             const ros::Time& stamp, MarkerArray& markers) {
  constexpr double kDiameter = 0.004;  // m
  Marker tip = newMarker(style.frame, stamp, "tip", 0, Marker::SPHERE);
  setBall(tip, predicted, kDiameter, color(0.1, 0.8, 0.2, 1.0));
  Marker seen = newMarker(style.frame, stamp, "tip", 1, Marker::SPHERE);
  setBall(seen, measured ? measured->p : predicted, kDiameter, color(0.95, 0.1, 0.1, 1.0));
  Marker line = newMarker(style.frame, stamp, "tip", 2, Marker::LINE_LIST);
  line.scale.x = 0.001;
  line.color = color(0.95, 0.1, 0.1, 1.0);
  if (measured) line.points = {toPoint(predicted), toPoint(measured->p)};
  else seen.action = line.action = Marker::DELETE;
  markers.markers.insert(markers.markers.end(), {tip, seen, line});
}

Marker eigenvalueText(const Estimate& estimate, bool stale, const MarkerStyle& style, const ros::Time& stamp) {
  char text[160];
  const Vector3 cm_per_n = 100.0 * estimate.tip_ellipsoid.half_axes;
  std::snprintf(text, sizeof text, "%.3g / %.3g / %.3g cm/N%s", cm_per_n[0], cm_per_n[1], cm_per_n[2],
                stale ? " STALE" : "");
  Marker marker = newMarker(style.frame, stamp, "text", 0, Marker::TEXT_VIEW_FACING);
  setText(marker, estimate.solution.X_BT.p + Vector3(0.0, 0.0, 0.022), 0.005, text);
  if (stale) marker.color = color(1.0, 0.3, 0.2, 1.0);
  return marker;
}

// Vector of the arrow of a force, limited in length.
Vector3 arrowOf(const Vector3& force, double force_n_per_m) {
  constexpr double kLongest = 0.2;  // m
  const double length = force.norm() / force_n_per_m;
  return (length > kLongest ? kLongest / length : 1.0) / force_n_per_m * force;
}

}  // namespace

MarkerArray makeMarkers(const Estimate& estimate, const std::optional<Pose>& measured_tip, bool stale,
                        const MarkerStyle& style, const ros::Time& stamp) {
  MarkerArray markers;
  markers.markers.push_back(tube(estimate.shape, stale, style, stamp));
  const size_t per_segment = estimate.stations.size() / std::max<size_t>(1, estimate.stretch.size());
  for (size_t i = 0; i < estimate.stations.size(); ++i) {
    Marker marker = newMarker(style.frame, stamp, "ellipsoids", static_cast<int>(i), Marker::SPHERE);
    const Station& station = estimate.stations[i];
    setEllipsoid(marker, ellipsoidOf(station.compliance.topLeftCorner<3, 3>()), station.X_BQ.p, style.ellipsoid_scale);
    marker.color = segmentColor(i / per_segment, stale);
    markers.markers.push_back(marker);
  }
  Marker tip = newMarker(style.frame, stamp, "tip_ellipsoid", 0, Marker::SPHERE);
  setEllipsoid(tip, estimate.tip_ellipsoid, estimate.solution.X_BT.p, style.ellipsoid_scale);
  tip.color = stale ? color(0.5, 0.5, 0.5, 0.5) : color(1.0, 0.6, 0.15, 0.75);
  markers.markers.push_back(tip);
  addTips(estimate.solution.X_BT.p, measured_tip, style, stamp, markers);
  markers.markers.push_back(eigenvalueText(estimate, stale, style, stamp));
  return markers;
}

MarkerArray makeEigenscrewMarkers(const Estimate& estimate, bool stale, double length, const MarkerStyle& style,
                                  const ros::Time& stamp) {
  const EigenscrewDecomposition decomposition = eigenscrewsOfStiffness(estimate.stiffness);
  MarkerArray markers;
  for (int i = 0; i < 6; ++i) {
    const Eigenscrew& screw = decomposition.screws[i];
    const bool is_positive = screw.eigenvalue > 0.0;
    const Vector3 middle = estimate.solution.X_BT.p + screw.point, half = 0.5 * length * screw.direction;
    Marker line = newMarker(style.frame, stamp, "eigenscrews", i, Marker::LINE_LIST);
    line.scale.x = 0.0007;
    line.color = is_positive ? color(1.0, 0.35, 0.3, 1.0) : color(0.4, 0.6, 1.0, 1.0);
    line.points = {toPoint(middle - half), toPoint(middle + half)};
    char text[80];
    std::snprintf(text, sizeof text, "%+.3g N, %+.3g mm/rad", screw.eigenvalue, 1e3 * screw.pitch);
    Marker label = newMarker(style.frame, stamp, "eigenscrews", 6 + i, Marker::TEXT_VIEW_FACING);
    // Positive and negative screws often share a line, so their labels are at its two ends.
    setText(label, middle + (is_positive ? 1.05 : -1.05) * half, 0.003, text);
    label.color = line.color;
    markers.markers.insert(markers.markers.end(), {line, label});
  }
  if (stale || !decomposition.definite) deleteAll(markers);
  return markers;
}

MarkerArray makeGhostMarkers(const Ghost* ghost, double force_n_per_m, const MarkerStyle& style,
                             const ros::Time& stamp) {
  MarkerArray markers;
  const auto add = [&](const std::string& name, int id, int type) -> Marker& {
    markers.markers.push_back(newMarker(style.frame, stamp, name, id, type));
    return markers.markers.back();
  };
  markers.markers.reserve(4);
  Marker &tube = add("ghost", 0, Marker::TRIANGLE_LIST), &tip = add("ghost", 1, Marker::SPHERE),
         &arrow = add("ghost_force", 0, Marker::ARROW), &text = add("ghost_text", 0, Marker::TEXT_VIEW_FACING);
  if (ghost == nullptr) {
    deleteAll(markers);
    return markers;
  }
  setText(text, ghost->text_place, 0.0035, ghost->text);
  if (ghost->shape.empty()) {
    tube.action = tip.action = arrow.action = Marker::DELETE;
    text.color = color(1.0, 0.5, 0.3, 1.0);
    return markers;
  }
  const std_msgs::ColorRGBA shade = color(0.85, 0.9, 1.0, 0.45);
  setTube(tube, ghost->shape, style.tube_radius, {shade});
  setBall(tip, ghost->X_BT.p, 0.004, shade);
  setArrow(arrow, ghost->X_BT.p, ghost->X_BT.p + arrowOf(ghost->force, force_n_per_m), color(1.0, 0.9, 0.2, 1.0));
  return markers;
}

MarkerArray makeContactMarkers(const Vector3& tip, const Vector3& force, double deviation, bool in_contact,
                               double force_n_per_m, const MarkerStyle& style, const ros::Time& stamp) {
  MarkerArray markers;
  markers.markers = {newMarker(style.frame, stamp, "contact", 0, Marker::ARROW),
                     newMarker(style.frame, stamp, "contact", 1, Marker::TEXT_VIEW_FACING)};
  const Vector3 tail = tip - arrowOf(force, force_n_per_m);
  const std_msgs::ColorRGBA shade = color(1.0, 0.3, 0.85, 1.0);
  setArrow(markers.markers[0], tail, tip, shade);
  char text[64];
  std::snprintf(text, sizeof text, "%.2f +- %.2f N", force.norm(), deviation);
  setText(markers.markers[1], tail + Vector3(0.0, 0.0, 0.005), 0.005, text);
  markers.markers[1].color = shade;
  if (!in_contact) deleteAll(markers);
  return markers;
}

}  // namespace live_stiffness
