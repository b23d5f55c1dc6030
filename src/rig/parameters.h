#pragma once
// The parameters of rig_simulator, in the form of live_stiffness/parameters.h: the simulated rig takes its defaults and
// ranges from here, and config/rig_simulator.yaml is written from here.
//
// The simulated robot is a finer model than the node's: the limit of small pressure steps, integrated on its own.

#include "live_stiffness/parameters.h"

namespace live_stiffness {

// --- Pressures ---
inline const ChoiceParameter kProgram{
    "program", "triangle", {"triangle", "staircase", "random_walk"},
    "triangle: channels up and down one after the other; staircase: one channel at a time in thirds; random_walk."};
inline constexpr NumberParameter kAmplitude{"amplitude_pa", 80000.0, {0.0, 1e6}, "Highest pressure of the program."};
inline constexpr NumberParameter kPeriod{"period_s", 10.0, {0.1, 3600.0}, "Period of the program."};
inline constexpr NumberParameter kSeed{
    "seed", 1, {0, 1e9}, "Of everything random: walk, regulator error, noise, drop-outs."};
inline constexpr NumberParameter kSampleRate{"rate_hz", 40.0, {1.0, 1000.0}, "Samples in a second."};
inline const NumbersParameter kRigChannelOfChamber = kChannelOfChamber;
inline constexpr NumberParameter kRegulatorTimeConstant{
    "regulator_time_constant_s", 0.1, {0.0, 10.0}, "The regulator follows its command with this lag."};
inline constexpr NumberParameter kRegulatorError{
    "regulator_error_pa", 3000.0, {0.0, 1e5},
    "Bound of the regulator's slow error, which only the robot feels."};
inline constexpr NumberParameter kCreepFraction{
    "creep_fraction", 0.05, {0.0, 0.5},
    "After a step of pressure the robot reaches 1 - creep_fraction at once and creeps the rest."};
inline constexpr NumberParameter kCreepTimeConstant{
    "creep_time_constant_s", 2.0, {0.01, 1000.0}, "Time constant of the creep."};

// --- Tracker ---
inline constexpr NumberParameter kPositionNoise{
    "position_noise_m", 0.48e-3, {0.0, 0.1}, "RMS length of the tracker's position error."};
inline constexpr NumberParameter kRotationNoise{
    "rotation_noise_deg", 0.30, {0.0, 28.0}, "RMS length of the tracker's rotation error.", Live::kNo, kDegree};
inline constexpr NumberParameter kDropOutProbability{
    "drop_out_probability", 0.002, {0.0, 1.0}, "Chance for each sample that a drop-out of the tracker begins."};
inline constexpr NumberParameter kDropOutDuration{"drop_out_duration_s", 0.5, {0.0, 3600.0}, "How long a drop-out lasts."};
inline constexpr FileParameter kRigRegistrationFile{
    "registration_file", "", "Where the base is in the tracker's frame and the sensor on the tip (YAML). Empty: both identity."};
inline constexpr FrameParameter kRigTrackerFrame{"tracker_frame", "aurora", "frame_id of the tracker's poses."};
inline constexpr FrameParameter kRigBaseFrame = kBaseFrame;

// --- Contact ---
// A pusher that touches the tip. Truth comes on ~true_tip_wrench (base axes) and, as from a force sensor at the tip point
// in axes of the tip, on tip_force_torque (frame tip_force_sensor).
inline const NumbersParameter kPushForce{
    "contact_force_n", {0.0, 0.0, 0.0}, Range::finite(),
    "Force at the tip point, base axes, of the first push at its height; with the moment zero: nothing touches."};
inline const NumbersParameter kPushMoment{
    "contact_moment_n_m", {0.0, 0.0, 0.0}, Range::finite(), "Moment about the tip point, likewise."};
inline constexpr NumberParameter kPushStart{"contact_start_s", 5.0, {0.0, 1e5}, "When the first push begins."};
inline constexpr NumberParameter kPushDuration{
    "contact_duration_s", 4.0, {0.1, 3600.0}, "How long each push lasts, rise and fall included."};
inline constexpr NumberParameter kPushRamp{
    "contact_ramp_s", 0.5, {0.0, 1800.0}, "How long rise and fall take, each; at most half of the duration."};
inline constexpr NumberParameter kPushPeriod{
    "contact_period_s", 10.0, {0.0, 1e5}, "From push to push, at least the duration; 0: one push only."};
inline constexpr NumberParameter kPushTurn{
    "contact_turn_deg", 90.0, {-360.0, 360.0}, "How far the wrench turns about z of the base from push to push.",
    Live::kNo, kDegree};

}  // namespace live_stiffness
