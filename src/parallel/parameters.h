#pragma once
// The parameters of parallel_node and parallel_rig, in the form of live_stiffness/parameters.h: config/parallel_node.yaml
// and docs/parameters.md are written from here.

#include "live_stiffness/parameters.h"

namespace live_stiffness {

// --- Model ---
inline constexpr NumberParameter kParallelAccuracy = kAccuracy;
inline constexpr NumberParameter kParallelHeartbeat{
    "heartbeat_hz", 1.0, kHeartbeat.range,
    "While the lengths are stale or bad, the last good estimate is published again, marked stale, at this rate."};

// --- Rod lengths: topic rod_lengths ---
// live_stiffness/RodLengths, std_msgs/Float64MultiArray or std_msgs/Float32MultiArray; the type is recognised. One length
// for each rod between base and platform, in the order of the scene. Every new set of lengths is solved.
inline const ChoiceParameter kLengthUnit{"length_unit", "m", {"m", "mm"}, "Unit of the numbers on the topic."};
inline constexpr NumberParameter kLengthTimeout{
    "length_timeout_s", 0.5, Range::positive(),
    "Lengths older than this are stale: diagnostics ERROR, estimates marked stale."};

// --- External wrench on the platform: topic platform_wrench (geometry_msgs/WrenchStamped) ---
// Acts at the platform's origin P, beside its weight. frame_id: base_frame or platform_frame (the axes it is given in).
inline constexpr NumberParameter kPlatformWrenchTimeout{
    "platform_wrench_timeout_s", 1.0, Range::nonnegative(),
    "After this time without a message the wrench counts as zero; 0: the last one is kept for ever."};

// --- Output ---
inline constexpr FrameParameter kParallelBaseFrame = kBaseFrame;
inline constexpr FrameParameter kPlatformFrame{"platform_frame", "platform", "Frame of the platform as predicted."};
inline constexpr NumberParameter kParallelEllipsoidScale{
    "ellipsoid_scale_m_per_m_n", 50.0, kEllipsoidScale.range,
    "Half axis drawn for a translational compliance, m for each m/N: the displacement under a force of this many newton. "
    "Steel rods are stiff."};
inline constexpr NumberParameter kRotationEllipsoidScale{
    "rotation_ellipsoid_scale_m_per_rad_n_m", 0.6, {1e-6, 1e6},
    "Half axis drawn for a rotational compliance, m for each rad/(N m)."};
inline constexpr NumberParameter kParallelMarkerRate = kMarkerRate;

// === parallel_rig ===
// --- Motion of the platform ---
inline constexpr NumberParameter kCircleRadius{
    "radius_m", 0.1, Range::nonnegative(), "Radius of the circle round which the platform is led."};
inline constexpr NumberParameter kCircleHeight{"height_m", 0.4, Range::positive(), "Its height above the base."};
inline constexpr NumberParameter kCirclePeriod{
    "period_s", 20.0, Range::nonnegative(), "Time of a round; 0: the platform stands still on the circle, at x = radius."};
inline constexpr NumberParameter kLengthRate{"rate_hz", 20.0, {1.0, 1000.0}, "Sets of lengths in a second."};

}  // namespace live_stiffness
