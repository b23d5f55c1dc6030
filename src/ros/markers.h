#pragma once
// Pictures of an estimate for rviz. What is not to be seen is left out.

#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/stiffness_estimator.h"
#include "ros/marker_shapes.h"

namespace live_stiffness {

// Markers, by namespace: `backbone` (tube, blue to red with the local compliance), `ellipsoids` (translational
// compliance at the stations, a colour per segment), `tip_ellipsoid` (tangent, at T), `tip` (predicted and, if given,
// measured tip, and the line between), `text` (eigenvalues). Shapes are grey when stale.
visualization_msgs::MarkerArray makeMarkers(const Estimate& estimate, const std::optional<Pose>& measured_tip, bool stale,
                                            const MarkerStyle& style, const ros::Time& stamp);

// Namespace `eigenscrews`: the axes of the six eigenscrews (21) of the stiffness as lines in space, `length` (m) long,
// about the point of each that is nearest to T; red: positive, blue: negative; each with its eigenstiffness and pitch.
// None when stale, or when the stiffness has no eigenscrews.
visualization_msgs::MarkerArray makeEigenscrewMarkers(const Estimate& estimate, bool stale, double length,
                                                      const MarkerStyle& style, const ros::Time& stamp);

// Namespace `contact`: an arrow that pushes the tip (base frame, m) with the force estimated there (base axes, N),
// force_n_per_m newton a metre of length, and its size with the standard deviation (N) of it.
visualization_msgs::MarkerArray makeContactMarkers(const Vector3& tip, const Vector3& force, double deviation,
                                                   double force_n_per_m, const MarkerStyle& style, const ros::Time& stamp);

// The shape of the robot under an additional wrench.
struct Ghost {
  std::vector<Pose> shape;          // sections, base to tip; empty: there is no equilibrium to show
  Pose X_BT;                        // its tip
  Vector3 force = Vector3::Zero();  // added at T, base axes, N
  Vector3 text_place = Vector3::Zero();  // m
  std::string text;
};
// Namespaces `ghost` (tube and tip), `ghost_force` (arrow from the tip, force_n_per_m newton a metre of length) and
// `ghost_text`.
visualization_msgs::MarkerArray makeGhostMarkers(const Ghost& ghost, double force_n_per_m, const MarkerStyle& style,
                                                 const ros::Time& stamp);

}  // namespace live_stiffness
