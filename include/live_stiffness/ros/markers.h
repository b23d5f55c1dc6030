#pragma once
// Pictures of an estimate for rviz.

#include <visualization_msgs/MarkerArray.h>

#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/stiffness_estimator.h"

namespace live_stiffness {

struct MarkerStyle {
  std::string frame;             // base frame
  double ellipsoid_scale = 0.3;  // half axis drawn per compliance, m per (m/N)
  double tube_radius = 0.0015;   // of the backbone, m
};

// Markers, by namespace: `backbone` (tube, blue to red with the local compliance), `ellipsoids` (translational
// compliance at the stations), `tip_ellipsoid` (tangent, at T), `tip` (predicted and, if given, measured tip, and the
// line between), `text` (eigenvalues). Shapes are grey when stale. Every call returns the same ids, so that each
// replaces its predecessor. samples: the shape, base to tip; not empty.
visualization_msgs::MarkerArray makeMarkers(const Estimate& estimate, const std::vector<Station>& samples,
                                            const std::optional<Pose>& measured_tip, bool stale,
                                            const MarkerStyle& style, const ros::Time& stamp);

}  // namespace live_stiffness
