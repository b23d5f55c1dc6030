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

std_msgs::ColorRGBA color(double r, double g, double b, double a = 1.0);
// Blue (0) over white to red (1); grey when stale.
std_msgs::ColorRGBA blueToRed(double fraction, bool stale);

// Markers of one picture, all in one frame and with one stamp. MarkerPublisher deletes those of the picture before.
class Picture {
 public:
  using Marker = visualization_msgs::Marker;
  using Color = std_msgs::ColorRGBA;

  Picture(std::string frame, const ros::Time& stamp) : frame_(std::move(frame)), stamp_(stamp) {}

  // At the origin of the frame, with action ADD. The reference holds until the next one is added.
  Marker& add(const std::string& name, int id, int type, const Color& shade = color(1.0, 1.0, 1.0));
  // Tube (triangles) through the sections of a rod, base to tip; colors: one a section, or one for all.
  void addTube(const std::string& name, int id, const std::vector<Pose>& sections, double radius,
               const std::vector<Color>& colors);
  // SPHERE with half axes `scale` times those of the ellipsoid, kept within what can be drawn.
  void addEllipsoid(const std::string& name, int id, const Ellipsoid& ellipsoid, const Vector3& centre, double scale,
                    const Color& shade);
  // SPHERE of this diameter, m.
  void addBall(const std::string& name, int id, const Vector3& centre, double diameter, const Color& shade);
  // ARROW from one point to another; none if they are less than 0.1 mm apart.
  void addArrow(const std::string& name, int id, const Vector3& from, const Vector3& to, const Color& shade);
  // LINE_LIST of one line, width in m.
  void addLine(const std::string& name, int id, const Vector3& from, const Vector3& to, double width, const Color& shade);
  // TEXT_VIEW_FACING of this height, m.
  void addText(const std::string& name, int id, const Vector3& place, double height, const std::string& text,
               const Color& shade = color(1.0, 1.0, 1.0));

  const visualization_msgs::MarkerArray& markers() const { return markers_; }

 private:
  std::string frame_;
  ros::Time stamp_;
  visualization_msgs::MarkerArray markers_;
};

}  // namespace live_stiffness
