#pragma once
// Pictures of a parallel robot for rviz.

#include "parallel/parallel_estimator.h"
#include "parallel/parameters.h"
#include "ros/marker_shapes.h"

namespace live_stiffness {

struct ParallelMarkerStyle : MarkerStyle {
  ParallelMarkerStyle() { ellipsoid_scale = kParallelEllipsoidScale.standard; }

  double rotation_scale = kRotationEllipsoidScale.standard;  // half axis per rotational compliance, m per (rad/(N m))
};

// Markers, by namespace: `rods` (tubes, a colour each, as thick as they are), `platform` and `base` (plates through the
// rods' ends and holes), `translation_ellipsoid` and `rotation_ellipsoid` (tangent, at P), `text` (their eigenvalues).
// Grey when stale. Every call returns the same ids, so that each replaces its predecessor.
visualization_msgs::MarkerArray makeParallelMarkers(const ParallelEstimate& estimate, const ParallelScene& scene,
                                                    bool stale, const ParallelMarkerStyle& style,
                                                    const ros::Time& stamp);

}  // namespace live_stiffness
