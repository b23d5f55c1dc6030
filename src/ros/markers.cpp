#include "ros/markers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "live_stiffness/analysis/eigenscrews.h"
#include "ros/conversions.h"

namespace live_stiffness {
namespace {

using visualization_msgs::MarkerArray;

Ellipsoid ellipsoidAt(const Station& station) { return ellipsoidOf(station.compliance.topLeftCorner<3, 3>()); }

void addBackbone(const std::vector<Station>& shape, bool stale, double radius, Picture& picture) {
  std::vector<Pose> sections;
  std::vector<double> compliance;
  for (const Station& station : shape) {
    sections.push_back(station.X_BQ);
    compliance.push_back(ellipsoidAt(station).half_axes.z());
  }
  const double largest = std::max(1e-12, *std::max_element(compliance.begin(), compliance.end()));
  std::vector<std_msgs::ColorRGBA> colors;
  // Cube root, since compliance grows with about the cube of the arc length.
  for (double value : compliance) colors.push_back(blueToRed(std::cbrt(value / largest), stale));
  picture.addTube("backbone", 0, sections, radius, colors);
}

// Of the segments in turn: blue, green, violet, yellow, and again.
std_msgs::ColorRGBA segmentColor(size_t segment, bool stale) {
  if (stale) return color(0.6, 0.6, 0.6, 0.35);
  const std_msgs::ColorRGBA palette[] = {color(0.35, 0.65, 1.0, 0.6), color(0.4, 0.85, 0.4, 0.6),
                                         color(0.75, 0.5, 1.0, 0.6), color(0.95, 0.9, 0.35, 0.6)};
  return palette[segment % 4];
}

void addTips(const Vector3& predicted, const std::optional<Pose>& measured, Picture& picture) {
  constexpr double kDiameter = 0.004;  // m
  const std_msgs::ColorRGBA red = color(0.95, 0.1, 0.1);
  picture.addBall("tip", 0, predicted, kDiameter, color(0.1, 0.8, 0.2));
  if (!measured) return;
  picture.addBall("tip", 1, measured->p, kDiameter, red);
  picture.addLine("tip", 2, predicted, measured->p, 0.001, red);
}

std::string eigenvalueText(const Estimate& estimate, bool stale) {
  char text[160];
  const Vector3 cm_per_n = 100.0 * estimate.tip_ellipsoid.half_axes;
  std::snprintf(text, sizeof text, "%.3g / %.3g / %.3g cm/N%s", cm_per_n[0], cm_per_n[1], cm_per_n[2],
                stale ? " STALE" : "");
  return text;
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
  Picture picture(style.frame, stamp);
  const Vector3& tip = estimate.solution.X_BT.p;
  addBackbone(estimate.shape, stale, style.tube_radius, picture);
  const size_t per_segment = estimate.stations.size() / std::max<size_t>(1, estimate.stretch.size());
  for (size_t i = 0; i < estimate.stations.size(); ++i)
    picture.addEllipsoid("ellipsoids", static_cast<int>(i), ellipsoidAt(estimate.stations[i]), estimate.stations[i].X_BQ.p,
                         style.ellipsoid_scale, segmentColor(i / per_segment, stale));
  picture.addEllipsoid("tip_ellipsoid", 0, estimate.tip_ellipsoid, tip, style.ellipsoid_scale,
                       stale ? color(0.5, 0.5, 0.5, 0.5) : color(1.0, 0.6, 0.15, 0.75));
  addTips(tip, measured_tip, picture);
  picture.addText("text", 0, tip + Vector3(0.0, 0.0, 0.022), 0.005, eigenvalueText(estimate, stale),
                  stale ? color(1.0, 0.3, 0.2) : color(1.0, 1.0, 1.0));
  return picture.markers();
}

MarkerArray makeEigenscrewMarkers(const Estimate& estimate, bool stale, double length, const MarkerStyle& style,
                                  const ros::Time& stamp) {
  const EigenscrewDecomposition decomposition = eigenscrewsOfStiffness(estimate.stiffness);
  if (stale || !decomposition.definite) return {};
  Picture picture(style.frame, stamp);
  for (int i = 0; i < 6; ++i) {
    const Eigenscrew& screw = decomposition.screws[i];
    const bool is_positive = screw.eigenvalue > 0.0;
    const std_msgs::ColorRGBA shade = is_positive ? color(1.0, 0.35, 0.3) : color(0.4, 0.6, 1.0);
    const Vector3 middle = estimate.solution.X_BT.p + screw.point, half = 0.5 * length * screw.direction;
    picture.addLine("eigenscrews", i, middle - half, middle + half, 0.0007, shade);
    char text[80];
    std::snprintf(text, sizeof text, "%+.3g N, %+.3g mm/rad", screw.eigenvalue, 1e3 * screw.pitch);
    // Positive and negative screws often share a line, so their labels are at its two ends.
    picture.addText("eigenscrews", 6 + i, middle + (is_positive ? 1.05 : -1.05) * half, 0.003, text, shade);
  }
  return picture.markers();
}

MarkerArray makeGhostMarkers(const Ghost& ghost, double force_n_per_m, const MarkerStyle& style, const ros::Time& stamp) {
  Picture picture(style.frame, stamp);
  const bool has_shape = !ghost.shape.empty();
  if (has_shape) {
    const std_msgs::ColorRGBA shade = color(0.85, 0.9, 1.0, 0.45);
    const Vector3& tip = ghost.X_BT.p;
    picture.addTube("ghost", 0, ghost.shape, style.tube_radius, {shade});
    picture.addBall("ghost", 1, tip, 0.004, shade);
    picture.addArrow("ghost_force", 0, tip, tip + arrowOf(ghost.force, force_n_per_m), color(1.0, 0.9, 0.2));
  }
  picture.addText("ghost_text", 0, ghost.text_place, 0.0035, ghost.text,
                  has_shape ? color(1.0, 1.0, 1.0) : color(1.0, 0.5, 0.3));
  return picture.markers();
}

MarkerArray makeContactMarkers(const Vector3& tip, const Vector3& force, double deviation, double force_n_per_m,
                               const MarkerStyle& style, const ros::Time& stamp) {
  Picture picture(style.frame, stamp);
  const Vector3 tail = tip - arrowOf(force, force_n_per_m);
  const std_msgs::ColorRGBA shade = color(1.0, 0.3, 0.85);
  picture.addArrow("contact", 0, tail, tip, shade);
  char text[64];
  std::snprintf(text, sizeof text, "%.2f +- %.2f N", force.norm(), deviation);
  picture.addText("contact", 1, tail + Vector3(0.0, 0.0, 0.005), 0.005, text, shade);
  return picture.markers();
}

}  // namespace live_stiffness
