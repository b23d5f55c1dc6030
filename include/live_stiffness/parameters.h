#pragma once
// The parameters of stiffness_node, of which the core has some as options: each stands here, and here alone.
//
// From here come what the node reads, what can be changed while it runs (cfg/Stiffness.cfg), options of programs, texts
// of errors, config/stiffness_node.yaml and docs/parameters.md (by scripts/reference). A new parameter is a definition
// here, and its field with a line of forEachParameter() in the struct that has it. scripts/parameter_specs.py reads this
// file: headings `// --- ... ---`, comments between, and definitions in the form of these.

#include "live_stiffness/checks.h"
#include "live_stiffness/conventions.h"

namespace live_stiffness {

inline constexpr FileParameter kSceneFile{"scene_file", "", "The robot: path of a scene. It has no default."};

// --- Model ---
inline const ChoiceParameter kModel{
    "model", "ncm", {"lpcc", "npcc", "lcm", "ncm"},
    "Shorthand of the paper for two switches: lpcc and npcc ignore external loads (weight, tip wrench), lpcc and lcm step "
    "once and never update the section. ncm is the full model.", Live::kRobot};
inline const ChoiceParameter kStepping{
    "stepping", "", {"", "fixed_step", "continuous", "linear"},
    "How pressures are stepped: fixed_step (n equal steps from zero pressure), continuous (their limit), linear. Empty: "
    "what the model implies.", Live::kRobot};
inline constexpr NumberParameter kPressureStep{
    "pressure_step_pa", 15000.0, {100.0, 1e7}, "Largest step of fixed_step.", Live::kRobot};
inline constexpr NumberParameter kAccuracy{
    "accuracy", 1e-9, {1e-13, 1e-2}, "Relative accuracy of pose and compliance.", Live::kRobot};
inline constexpr NumberParameter kUpdateThreshold{
    "update_threshold_pa", 1000.0, {0.0, 1e8},
    "Solve again when the 2-norm of the change of pressure exceeds this. 0: at every change.", Live::kRobot};
inline constexpr NumberParameter kHeartbeat{
    "heartbeat_hz", 1.0, {0.1, 1000.0}, "Solve again and publish at least this often."};

// --- Pressures: topic chamber_pressures ---
// live_stiffness/ChamberPressures, std_msgs/Float64MultiArray or std_msgs/Float32MultiArray; the type is recognised.
inline const ChoiceParameter kPressureUnit{
    "pressure_unit", "Pa", {"Pa", "kPa", "bar", "mbar", "psi"}, "Unit of the numbers on the topic."};
inline const ChoiceParameter kPressureReference{
    "pressure_reference", "gauge", {"gauge", "absolute"},
    "absolute: the pressure of the atmosphere is subtracted (of the node: atmospheric_pressure_pa; of programs: 101325 Pa)."};
inline constexpr NumberParameter kAtmosphericPressure{
    "atmospheric_pressure_pa", kAtmospherePa, {50e3, 120e3}, "Pressure around the robot, for absolute pressures."};
inline constexpr TextsParameter kPressureTopics{
    "pressure_topics",
    "Names of sensor_msgs/FluidPressure topics, one for each channel, instead of chamber_pressures. Empty: not used."};
inline constexpr int kMaxChannels = 1024;
inline const NumbersParameter kChannelOfChamber{
    "channel_of_chamber", {}, {0, kMaxChannels - 1},
    "For each chamber of the scene, base to tip, the channel (from 0) that feeds it: [0, 0, 1, 1, 2, 2] for three pairs. "
    "Other channels are spare. Empty: one channel for each chamber."};
inline constexpr NumberParameter kPressureTimeout{
    "pressure_timeout_s", 0.5, Range::positive(),
    "Pressures older than this are stale: diagnostics ERROR, estimates marked stale."};

// --- Tracker: topic aurora_pose ---
// geometry_msgs/PoseStamped, PoseWithCovarianceStamped or TransformStamped; the type is recognised. The tracker is
// optional: without it everything but the tracking error and contact is published.
inline const ChoiceParameter kPositionUnit{"aurora_position_unit", "m", {"m", "mm"}, "Unit of the positions."};
inline const ChoiceParameter kTrackerMeasures{
    "tracker_measures", "", {"", "pose", "position", "position_and_axis"},
    "What the tracker measures of its sensor: all; its position only (one marker); or its position and its z axis (a coil "
    "with five degrees of freedom). Empty: found from the data, and said."};
inline constexpr FrameParameter kTrackerFrame{
    "tracker_frame", "aurora",
    "frame_id of the poses; a leading slash, an empty frame_id and sensor_frame are accepted too. Poses in other frames are "
    "those of other tools, and left out."};
inline constexpr FrameParameter kSensorFrame{
    "sensor_frame", "aurora_tip",
    "The tracker's name of the sensor on the tip. Where a message names its sensor (child_frame_id), others are left out. "
    "Empty: the first one seen."};
inline constexpr FrameParameter kTrackerTfFrame{
    "aurora_tf_frame", "",
    "Look up this frame in tf (from tracker_frame) instead of listening to the topic. Empty: topic."};
inline constexpr NumberParameter kPoseTimeout{
    "pose_timeout_s", 1.0, Range::positive(),
    "Poses older than this, or the same pose repeated for this long, are reported: diagnostics WARN."};
inline constexpr FileParameter kRegistrationFile{
    "registration_file", "",
    "Where the base is in the tracker's frame and the sensor on the tip, and how late the tracker is (YAML). Empty: not known "
    "until ~register finds it, and until then there is no tracking error, no contact and no transform from tracker to base. "
    "~register finds all but the delay, and writes such a file."};
inline constexpr NumberParameter kRegistrationBuffer{
    "registration_buffer_s", 120.0, {1.0, 3600.0}, "How much of the newest past ~register can use."};

// --- External wrench at the tip point: topic tip_wrench (geometry_msgs/WrenchStamped) ---
// frame_id: base_frame or tip_frame (the axes it is given in).
inline constexpr NumberParameter kTipWrenchTimeout{
    "tip_wrench_timeout_s", 1.0, Range::nonnegative(),
    "After this time without a message the wrench counts as zero; 0: the last one is kept for ever."};

// --- Contact: topics ~tip_contact and ~tip_wrench_estimate ---
// A filter that estimates the external wrench at the tip point from tracker and model; docs/estimation.md says how it
// works. Standard deviations, forces and positions are for each axis.
inline constexpr NumberParameter kWrenchComponents{
    "wrench_components", 3, {3, 6}, "3: a pure force at the tip point; 6: force and moment. No other number."};
inline constexpr NumberParameter kTrackerPositionNoise{
    "tracker_position_noise_m", 2e-3, {1e-6, 0.1},
    "White noise of the tracker and of what the model does not follow from sample to sample. An NDI Aurora alone has "
    "0.28e-3; silicone arms in motion are millimetres from their model."};
inline constexpr NumberParameter kTrackerRotationNoise{
    "tracker_rotation_noise_deg", 28.64788975654116, {1e-3, 57.0},
    "The same of its rotation (0.5 rad); an NDI Aurora alone has 0.17. By default rotation hardly counts, since the tip of a "
    "silicone arm turns about its own axis as no model says. Lower it for wrench_components: 6.", Live::kNo, kDegree};
inline constexpr NumberParameter kContactForce{
    "contact_force_n", 0.3, {1e-3, 1e4}, "How large to expect the force in contact."};
inline constexpr NumberParameter kModelErrorPosition{
    "model_error_position_m", 1.5e-3, {0.0, 0.1},
    "Size of the slow error of the model's tip position, which is not to be taken for force."};
inline constexpr NumberParameter kModelErrorRotation{
    "model_error_rotation_deg", 4.0, {0.0, 57.0}, "The same of the tip's rotation.", Live::kNo, kDegree};
inline constexpr NumberParameter kStiffnessScaleDeviation{
    "stiffness_scale_deviation", 0.0, {0.0, 1.0},
    "How uncertain the moduli of the scene are: standard deviation of the logarithm of a factor on all of them, which is "
    "learnt without contact. 0: it stays 1."};
inline constexpr NumberParameter kContactOnForce{
    "contact_on_force_n", 0.1, {1e-4, 1e3}, "Contact begins above this force, and ends below 0.6 times it.",
    Live::kContact};

// --- Output ---
inline constexpr FrameParameter kBaseFrame{"base_frame", "base", "Frame of the base."};
inline constexpr FrameParameter kTipFrame{"tip_frame", "tip", "Frame of the tip point as predicted."};
inline const NumbersParameter kEllipsoidFractions{
    "ellipsoid_fractions", {0.5, 0.6, 0.7, 0.8, 1.0}, {0.0, 1.0},
    "Where along each segment ellipsoids are drawn, 0 (its base) to 1."};
inline constexpr NumberParameter kEllipsoidScale{
    "ellipsoid_scale_m_per_m_n", 0.3, {1e-6, 1e6},
    "Half axis drawn for a compliance, m for each m/N: the ellipsoid shows the displacement under a force of this many "
    "newton.", Live::kDisplay};
inline constexpr NumberParameter kContactArrow{
    "contact_arrow_n_per_m", 20.0, {1e-6, 1e6}, "Force for each metre of the arrow drawn at the tip in contact.",
    Live::kDisplay};
inline constexpr NumberParameter kMarkerRate{"marker_rate_hz", 10.0, {0.1, 100.0}, "How often markers are published."};
inline constexpr BooleanParameter kShowEigenscrews{
    "show_eigenscrews", false,
    "Draw the six eigenscrews (21) of the stiffness as lines through space, each with its eigenstiffness and pitch.",
    Live::kDisplay};
inline constexpr NumberParameter kEigenscrewLength{
    "eigenscrew_length_m", 0.06, {1e-4, 100.0}, "Length of these lines.", Live::kDisplay};
inline constexpr BooleanParameter kTipHandle{
    "tip_handle", true,
    "An interactive marker at the tip for rviz, on ~tip_marker: drag it and see the force needed and the robot deflected, "
    "as a ghost. Its menu (right click) switches to a wrench that holds a pose, and to the deflection under a wrench."};
inline constexpr NumberParameter kTipHandleForce{
    "tip_handle_force_n_per_m", 20.0, Range::positive(),
    "Force for each metre that the handle is dragged to apply a wrench, and of the arrow drawn."};
inline constexpr NumberParameter kTipHandleMoment{
    "tip_handle_moment_n_m_per_rad", 0.01, Range::positive(),
    "Moment for each radian that the handle is turned to apply a wrench."};

}  // namespace live_stiffness
