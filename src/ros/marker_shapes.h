#pragma once
// Shapes for rviz, used for all robots.

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "live_stiffness/analysis/ellipsoid.h"
#include "live_stiffness/lie/se3.h"
#include "live_stiffness/parameters.h"

namespace live_stiffness {

struct MarkerStyle {
  std::string frame;             // base frame
  double ellipsoid_scale = kEllipsoidScale.standard;  // half axis drawn per compliance, m per (m/N)
  double tube_radius = 0.0015;   // of the backbone, m
};

std_msgs::ColorRGBA color(double r, double g, double b, double a);
// Blue (0) over white to red (1); grey when stale.
std_msgs::ColorRGBA blueToRed(double fraction, bool stale);

// A white marker at the origin of the frame, with action ADD.
visualization_msgs::Marker newMarker(const std::string& frame, const ros::Time& stamp, const std::string& name, int id,
                                     int type);

// Tube (triangles) through the sections of a rod, base to tip; colors: one a section, or one for all.
void setTube(visualization_msgs::Marker& marker, const std::vector<Pose>& sections, double radius,
             const std::vector<std_msgs::ColorRGBA>& colors);

// SPHERE with half axes `scale` times those of the ellipsoid, kept within what can be drawn.
void setEllipsoid(visualization_msgs::Marker& marker, const Ellipsoid& ellipsoid, const Vector3& centre, double scale);

// SPHERE of this diameter, m.
void setBall(visualization_msgs::Marker& marker, const Vector3& centre, double diameter,
             const std_msgs::ColorRGBA& shade);

// ARROW from one point to another; DELETE if they are less than 0.1 mm apart.
void setArrow(visualization_msgs::Marker& marker, const Vector3& from, const Vector3& to,
              const std_msgs::ColorRGBA& shade);

// TEXT_VIEW_FACING of this height, m.
void setText(visualization_msgs::Marker& marker, const Vector3& place, double height, const std::string& text);

// The same markers with action DELETE.
void deleteAll(visualization_msgs::MarkerArray& markers);

}  // namespace live_stiffness
